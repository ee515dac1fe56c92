#include "core/portable_math.h"

#include <cmath>
#include <limits>

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

double exp(double x) {
  if (x > 709.782712893384) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0;
  // x = k·ln 2 + r with |r| ≤ ln 2 / 2, ln 2 in two parts so that r keeps its digits.
  const double k = std::floor(x * 1.44269504088896340736 + 0.5);
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  double sum = 1;
  for (int n = 17; n >= 1; --n) sum = 1 + sum * r / n;
  return std::ldexp(sum, static_cast<int>(k));
}

double pow(double x, double y) {
  if (x == 0) return y == 0 ? 1 : 0;
  return exp(y * log(x));
}

namespace {

/// sin and cos by their series, |r| ≤ π/4.
double sin_series(double r) {
  double sum = 1;
  for (int n = 19; n >= 3; n -= 2) sum = 1 - sum * r * r / (n * (n - 1));
  return r * sum;
}
double cos_series(double r) {
  double sum = 1;
  for (int n = 18; n >= 2; n -= 2) sum = 1 - sum * r * r / (n * (n - 1));
  return sum;
}

/// sin(x + quarter·π/2)
double sin_quarter(double x, int quarter) {
  // x = k·π/2 + r, π/2 in three parts of 33 bits so that k times each is exact.
  const double k = std::floor(x * 0.63661977236758134308 + 0.5);
  const double r = ((x - k * 1.57079632673412561417e+00) - k * 6.07710050630396597660e-11) -
                   k * 2.02226624879595063154e-21;
  switch ((static_cast<long long>(k) + quarter) & 3) {
    case 0:
      return sin_series(r);
    case 1:
      return cos_series(r);
    case 2:
      return -sin_series(r);
    default:
      return -cos_series(r);
  }
}

/// atan for 0 ≤ t ≤ 1: twice halved by atan t = 2 atan(t / (1 + √(1 + t²))), then the series.
double atan_unit(double t) {
  for (int halving = 0; halving < 2; ++halving) t = t / (1 + sqrt(1 + t * t));
  double sum = 0;
  for (int n = 25; n >= 1; n -= 2) sum = 1.0 / n - sum * t * t;
  return 4 * t * sum;
}

}  // namespace

double sin(double x) { return sin_quarter(x, 0); }
double cos(double x) { return sin_quarter(x, 1); }

double atan2(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0) return 0;
  double angle = ay <= ax ? atan_unit(ay / ax) : pi / 2 - atan_unit(ax / ay);
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

namespace {

template <std::size_t N>
double polynomial(const double (&coefficients)[N], double x) {
  double sum = 0;
  for (const double c : coefficients) sum = sum * x + c;
  return sum;
}

}  // namespace

// Acklam's rational approximation of the inverse normal distribution function (relative error
// 1.15e-9, well below float's): only division, square root and our own logarithm.
double inverse_normal(double p) {
  constexpr double a[] = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                          1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr double b[] = {-5.447609879822406e+01, 1.615858368580409e+02,  -1.556989798598866e+02,
                          6.680131188771972e+01,  -1.328068155288572e+01, 1.0};
  constexpr double c[] = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                          -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr double d[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                          3.754408661907416e+00, 1.0};
  constexpr double tail = 0.02425;
  if (p > 1 - tail) return -inverse_normal(1 - p);
  if (p < tail) {
    const double q = sqrt(-2 * log(p));
    return polynomial(c, q) / polynomial(d, q);
  }
  const double q = p - 0.5;
  return q * polynomial(a, q * q) / polynomial(b, q * q);
}

}  // namespace gramloom::portable
