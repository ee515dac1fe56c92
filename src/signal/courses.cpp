#include "signal/courses.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "signal/blur.h"
#include "signal/correlation.h"
#include "signal/resize.h"

namespace gramloom {

namespace {

constexpr int side_looked_at = 192;       // of the picture that is looked at
constexpr double slow_changes = 1.0 / 6;  // of the shorter side
constexpr double reach = 0.6;             // of the side: the largest shift
constexpr double least_period = 6;
constexpr double step = 0.25;
constexpr double nearly = 0.8;

double interpolated(const std::vector<double>& values, double at) {
  const auto low = static_cast<std::size_t>(at);
  if (low + 1 >= values.size()) return values.back();
  const double part = at - static_cast<double>(low);
  return values[low] * (1 - part) + values[low + 1] * part;
}

// Mean of the values at (k + offset) periods, k = first …
double mean_at(const std::vector<double>& values, double period, double offset) {
  double sum = 0;
  int count = 0;
  for (double at = (1 - offset) * period; at <= static_cast<double>(values.size() - 1);
       at += period, ++count)
    sum += interpolated(values, at);
  return count > 0 ? sum / count : 0;
}

}  // namespace

Courses find_courses(const Image& image, Axis axis) {
  Image small = fit_longer_side(image, side_looked_at);
  const Image slow = blurred(small, std::min(small.width, small.height) * slow_changes, Tile::none);
  for (std::size_t i = 0; i < small.pixels.size(); ++i) small.pixels[i] -= slow.pixels[i];
  const ShiftCorrelation self = shift_correlation(small, small);
  const int along = axis == Axis::y ? small.height : small.width;
  const int across = (axis == Axis::y ? small.width : small.height) / 2;
  const auto at = [&](int shift, int sideways) {
    return axis == Axis::y ? self.at(sideways, shift) : self.at(shift, sideways);
  };
  std::vector<double> profile;
  for (int shift = 0; shift < reach * along; ++shift) {
    double sum = 0;
    for (int sideways = -across; sideways <= across; ++sideways) sum += at(shift, sideways);
    profile.push_back(sum / (2 * across + 1));
  }
  const double longest = static_cast<double>(profile.size() - 1) / 2;
  const auto contrast_of = [&](double period) {
    return mean_at(profile, period, 0) - mean_at(profile, period, 0.5);
  };
  double most = 0;
  for (double period = least_period; period <= longest; period += step)
    most = std::max(most, contrast_of(period));
  // Three courses have the contrast of one: the first peak that is nearly the highest.
  Courses best;
  for (double period = least_period; period <= longest; period += step) {
    const double contrast = contrast_of(period);
    if (contrast > best.contrast && contrast >= nearly * most) best = {period, contrast, false};
    if (best.period > 0 && period > 1.3 * best.period) break;
  }
  if (best.period > 0) {
    const int one = static_cast<int>(std::lround(best.period));
    const int two = static_cast<int>(std::lround(2 * best.period));
    best.alternate = at(two, 0) > at(one, 0) + 0.05f;
    best.period *= static_cast<double>(axis == Axis::y ? image.height : image.width) / along;
  }
  return best;
}

}  // namespace gramloom
