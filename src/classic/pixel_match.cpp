#include "classic/pixel_match.h"

#include <algorithm>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// errors[i] += weight · Σ_c (values[i·channels + c] − colour[c])²
GRAMLOOM_SIMD void add_errors(const float* values, int channels, int count, float weight,
                              const float* colour, float* errors) {
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    for (int c = 0; c < channels; ++c) {
      const float difference = values[i * channels + c] - colour[c];
      sum += difference * difference;
    }
    errors[i] += weight * sum;
  }
}

}  // namespace

Reference::Reference(const Level& level, int reach)
    : size_(level.colours.size()),
      step_(level.step),
      border_(reach * level.step),
      padded_(mirrored(level.colours, border_)) {}

std::ptrdiff_t Reference::offset(int dx, int dy) const {
  return (static_cast<std::ptrdiff_t>(dy) * padded_.width + dx) * step_ * padded_.channels;
}

float Reference::error(std::span<const Known> neighbourhood, Point p) const {
  const float* centre = padded_.at(p.x + border_, p.y + border_);
  float error = 0;
  for (const Known& known : neighbourhood) {
    const float* values = centre + known.offset;
    float sum = 0;
    for (int c = 0; c < padded_.channels; ++c)
      sum += (values[c] - known.colour[c]) * (values[c] - known.colour[c]);
    error += known.weight * sum;
  }
  return error;
}

std::vector<float> Reference::errors(std::span<const Known> neighbourhood) const {
  const auto width = static_cast<std::size_t>(size_.width);
  std::vector<float> errors(width * static_cast<std::size_t>(size_.height), 0.0f);
  parallel_for(size_.height, 8, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = begin; y < end; ++y)
      for (const Known& known : neighbourhood)
        add_errors(padded_.at(border_, border_ + static_cast<int>(y)) + known.offset,
                   padded_.channels, size_.width, known.weight, known.colour,
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
