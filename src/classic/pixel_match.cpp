#include "classic/pixel_match.h"

#include <algorithm>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// errors[i] += weight · (values[i] − wanted)²
GRAMLOOM_SIMD void add_errors(const float* values, float wanted, float weight, int count,
                              float* errors) {
  for (int i = 0; i < count; ++i)
    errors[i] += weight * ((values[i] - wanted) * (values[i] - wanted));
}

/// The channels of an image, each as an image of its own.
std::vector<Image> planes_of(const Image& image) {
  std::vector<Image> planes;
  for (int c = 0; c < image.channels; ++c) planes.push_back(extract_channels(image, c, 1));
  return planes;
}

}  // namespace

Reference::Reference(const Level& level, int reach)
    : size_(level.colours.size()),
      step_(level.step),
      border_(reach * level.step),
      planes_(planes_of(mirrored(level.colours, border_))) {}

std::ptrdiff_t Reference::offset(int dx, int dy) const {
  return (static_cast<std::ptrdiff_t>(dy) * planes_.front().width + dx) * step_;
}

float Reference::error(std::span<const Known> neighbourhood, Point p) const {
  const std::size_t centre = planes_.front().index(p.x + border_, p.y + border_);
  float error = 0;
  for (std::size_t c = 0; c < planes_.size(); ++c) {
    const float* values = planes_[c].pixels.data() + centre;
    for (const Known& known : neighbourhood) {
      const float difference = values[known.offset] - known.colour[c];
      error += known.weight * (difference * difference);
    }
  }
  return error;
}

std::vector<float> Reference::errors(std::span<const Known> neighbourhood) const {
  const auto width = static_cast<std::size_t>(size_.width);
  std::vector<float> errors(width * static_cast<std::size_t>(size_.height), 0.0f);
  parallel_for(size_.height, 32, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = begin; y < end; ++y)
      for (std::size_t c = 0; c < planes_.size(); ++c)
        for (const Known& known : neighbourhood)
          add_errors(planes_[c].at(border_, border_ + static_cast<int>(y)) + known.offset,
                     known.colour[c], known.weight, size_.width,
                     errors.data() + static_cast<std::size_t>(y) * width);
  });
  return errors;
}

std::size_t pick(std::span<const float> errors, double tolerance, Random& random) {
  const float least = *std::min_element(errors.begin(), errors.end());
  const auto most = static_cast<float>(static_cast<double>(least) * (1 + tolerance));
  const auto good = std::count_if(errors.begin(), errors.end(), [&](float e) { return e <= most; });
  auto before = random.below(static_cast<std::uint32_t>(good));
  std::size_t i = 0;
  for (; errors[i] > most || before > 0; ++i)
    if (errors[i] <= most) --before;
  return i;
}

}  // namespace gramloom::pixel
