#include "neural/flow/sparse_detail.h"

#include <algorithm>
#include <cmath>

#include "signal/resize.h"

namespace gramloom::neural {

namespace {

struct Brightness {
  double variance, skewness;
};

Brightness brightness_of(const Image& grey) {
  const auto count = static_cast<double>(grey.pixels.size());
  double mean = 0, second = 0, third = 0;
  for (const float value : grey.pixels) mean += value;
  mean /= count;
  for (const float value : grey.pixels) {
    const double off = value - mean;
    second += off * off;
    third += off * off * off;
  }
  second /= count;
  third /= count;
  return {second, second > 0 ? third / std::pow(second, 1.5) : 0};
}

Image grey(const Image& image) {
  Image result(image.size(), 1);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    result.pixels[i / static_cast<std::size_t>(image.channels)] +=
        image.pixels[i] / static_cast<float>(image.channels);
  return result;
}

}  // namespace

double sparse_detail(const Image& image) {
  const Image whole = grey(image);
  const Brightness fine = brightness_of(whole);
  if (fine.variance <= 0) return 0;
  const auto quarter = [](int side) { return std::max(1, side / 4); };
  const Brightness coarse =
      brightness_of(resize(whole, {quarter(image.width), quarter(image.height)}));
  return std::abs(fine.skewness) * std::max(0.0, 1 - coarse.variance / fine.variance);
}

}  // namespace gramloom::neural
