#include "runs/mean_interval.h"

#include <cmath>
#include <numbers>

namespace gramloom {

namespace {

// The probability between -t and t.
double student_inside(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(degrees));
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1, sum = 0;
  for (int power = odd ? 1 : 0; power <= degrees - 2; power += 2) {
    sum += term;
    term *= cosine * cosine * (power + 1) / (power + 2);
  }
  return odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
}

}  // namespace

double student_quantile(double probability, int degrees) {
  const double inside = 2 * probability - 1;
  double low = 0, high = 1;
  while (student_inside(high, degrees) < inside) high *= 2;
  for (int step = 0; step < 100; ++step) {
    const double middle = (low + high) / 2;
    (student_inside(middle, degrees) < inside ? low : high) = middle;
  }
  return (low + high) / 2;
}

MeanInterval mean_interval(std::span<const double> values) {
  const auto count = static_cast<double>(values.size());
  MeanInterval interval{0, std::nullopt, static_cast<int>(values.size())};
  for (const double value : values) interval.mean += value / count;
  if (values.size() < 2) return interval;
  double squares = 0;
  for (const double value : values) squares += (value - interval.mean) * (value - interval.mean);
  interval.half_width = student_quantile(0.975, interval.count - 1) *
                        std::sqrt(squares / (count - 1)) / std::sqrt(count);
  return interval;
}

}  // namespace gramloom
