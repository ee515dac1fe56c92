#include "classic/pixel_match.h"

#include <algorithm>
#include <numeric>

#include "core/simd.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// The colour beyond the edges: far from all others, whose variance is 1, so that a neighbourhood
/// that leaves the exemplar loses to every one that doesn't.
constexpr float outside = 100;

/// errors[i] += weight · (values[i] − wanted)²
GRAMLOOM_SIMD void add_errors(const float* values, float wanted, float weight, int count,
                              float* errors) {
  for (int i = 0; i < count; ++i)
    errors[i] += weight * ((values[i] - wanted) * (values[i] - wanted));
}

/// The same of samples that may be used, and how much these count.
GRAMLOOM_SIMD void add_usable_errors(const float* values, const float* usable, float wanted,
                                     float weight, int count, float* errors) {
  for (int i = 0; i < count; ++i)
    errors[i] += weight * usable[i] * ((values[i] - wanted) * (values[i] - wanted));
}
GRAMLOOM_SIMD void add_weights(const float* usable, float weight, int count, float* weights) {
  for (int i = 0; i < count; ++i) weights[i] += weight * usable[i];
}

Image usable_of(const Level& level, int border) {
  const Size size = level.colours.size();
  Image usable(size.width + 2 * border, size.height + 2 * border, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      *usable.at(x + border, y + border) = level.may_use(level.index({x, y})) ? 1.0f : 0.0f;
  return usable;
}

/// The channels of an image, each as an image of its own with a border.
std::vector<Image> planes_of(const Image& image, int border) {
  std::vector<Image> planes;
  for (int c = 0; c < image.channels; ++c) {
    Image plane(image.width + 2 * border, image.height + 2 * border, 1, outside);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) *plane.at(x + border, y + border) = image.at(x, y)[c];
    planes.push_back(std::move(plane));
  }
  return planes;
}

}  // namespace

Reference::Reference(const Level& level, int reach)
    : size_(level.colours.size()),
      step_(level.step),
      border_(reach * level.step),
      planes_(planes_of(level.colours, border_)),
      usable_(usable_of(level, border_)) {}

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
  const std::size_t row_work = width * planes_.size() * neighbourhood.size() + 1;
  const auto rows = static_cast<std::int64_t>(1 + (std::size_t{1} << 19) / row_work);
  parallel_for(size_.height, rows, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = begin; y < end; ++y)
      for (std::size_t c = 0; c < planes_.size(); ++c)
        for (const Known& known : neighbourhood)
          add_errors(planes_[c].at(border_, border_ + static_cast<int>(y)) + known.offset,
                     known.colour[c], known.weight, size_.width,
                     errors.data() + static_cast<std::size_t>(y) * width);
  });
  return errors;
}

std::vector<float> Reference::far_errors(std::span<const Known> neighbourhood) const {
  const auto width = static_cast<std::size_t>(size_.width);
  std::vector<float> errors(width * static_cast<std::size_t>(size_.height), 0.0f);
  std::vector<float> weights(errors.size(), 0.0f);
  parallel_for(size_.height, 4, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = begin; y < end; ++y)
      for (const Known& known : neighbourhood) {
        const auto at = [&](const Image& plane) {
          return plane.at(border_, border_ + static_cast<int>(y)) + known.offset;
        };
        float* of_row = errors.data() + static_cast<std::size_t>(y) * width;
        for (std::size_t c = 0; c < planes_.size(); ++c)
          add_usable_errors(at(planes_[c]), at(usable_), known.colour[c], known.weight, size_.width,
                            of_row);
        add_weights(at(usable_), known.weight, size_.width,
                    weights.data() + static_cast<std::size_t>(y) * width);
      }
  });
  const double counted = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (counted == 0) return errors;
  const auto mean =
      static_cast<float>(std::accumulate(errors.begin(), errors.end(), 0.0) / counted);
  float all = 0;
  for (const Known& known : neighbourhood) all += known.weight;
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] += mean * (all - weights[i]);
  return errors;
}

bool fits_at_all(std::span<const float> errors, std::span<const Known> neighbourhood) {
  float weight = 0;
  for (const Known& known : neighbourhood) weight += known.weight;
  return std::any_of(errors.begin(), errors.end(), [&](float e) { return e <= 2 * weight; });
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
