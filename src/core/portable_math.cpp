#include "core/portable_math.h"

#include <cmath>

namespace gramloom::portable {

double sqrt(double x) { return std::sqrt(x); }  // IEEE 754 demands exact rounding

double log(double x) {
  // x = m·2ᵉ with m in [√½, √2): log x = e·ln 2 + 2 artanh((m − 1)/(m + 1)).
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  const double t = (m - 1) / (m + 1);
  const double t2 = t * t;
  double sum = 0;
  for (int k = 23; k >= 1; k -= 2) sum = sum * t2 + 1.0 / k;
  return exponent * 0.69314718055994530942 + 2 * t * sum;
}

}  // namespace gramloom::portable
