#include "classic/histogram.h"

#include <algorithm>
#include <cstdint>

#include "classic/known_pixels.h"
#include "core/threads.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// The pixels of an exemplar that may be drawn.
class Colours {
 public:
  explicit Colours(const Exemplar& exemplar) : width_(exemplar.image.width) {
    const std::size_t all = static_cast<std::size_t>(exemplar.image.width) *
                            static_cast<std::size_t>(exemplar.image.height);
    count_ = static_cast<std::uint32_t>(all);
    if (exemplar.mask.empty()) return;
    for (std::size_t i = 0; i < all; ++i)
      if (exemplar.mask.pixels[i] > 0.5f) usable_.push_back(static_cast<std::uint32_t>(i));
    count_ = static_cast<std::uint32_t>(usable_.size());
  }

  std::uint32_t count() const { return count_; }
  Source source(std::uint32_t rank, int exemplar) const {
    const auto drawn = static_cast<int>(usable_.empty() ? rank : usable_[rank]);
    return {drawn % width_, drawn / width_, exemplar};
  }

 private:
  int width_;
  std::uint32_t count_;
  std::vector<std::uint32_t> usable_;  // empty: all
};

/// The exemplar that a weight falls on, of which a part in [0, 1) is drawn.
int exemplar_at(const float* weights, int count, float part) {
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += weights[i];
  float left = part * sum;
  int last = 0;
  for (int i = 0; i < count; ++i) {
    if (weights[i] <= 0) continue;
    last = i;
    if (left < weights[i]) return i;
    left -= weights[i];
  }
  return last;
}

Source draw(const std::vector<Colours>& exemplars, const float* weights, Random& random) {
  if (weights) {
    const int i = exemplar_at(weights, static_cast<int>(exemplars.size()), random.uniform());
    const Colours& colours = exemplars[static_cast<std::size_t>(i)];
    return colours.source(random.below(colours.count()), i);
  }
  std::uint32_t all = 0;
  for (const Colours& colours : exemplars) all += colours.count();
  std::uint32_t rank = random.below(all);
  std::size_t i = 0;
  while (rank >= exemplars[i].count()) rank -= exemplars[i++].count();
  return exemplars[i].source(rank, static_cast<int>(i));
}

}  // namespace

Texture synthesise(const HistogramParams&, const Request& request, const Control& control) {
  check_request<HistogramParams>(request);
  const Target& target = request.target;
  const std::vector<Colours> exemplars(request.exemplars.begin(), request.exemplars.end());
  const bool weighed = request.exemplars.size() > 1 && !target.weights.empty();
  SourceMap source(target.size);
  control.step(0, 1);
  parallel_for(target.size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      Random row = request.random.stream(static_cast<std::uint64_t>(y));
      for (int x = 0; x < target.size.width; ++x)
        *source.at(x, y) = draw(exemplars, weighed ? map_at(target.weights, x, y) : nullptr, row);
    }
  });
  Texture texture = texture_of(std::move(source), request.exemplars);
  keep_known(texture.image, target);
  control.step(1, 1);
  return texture;
}

Cost estimate(const HistogramParams&, const RequestSize& request) {
  check_request<HistogramParams>(request);
  const int channels = request.exemplars.front().channels;
  double in = 0, usable = 0;
  for (const ExemplarSize& exemplar : request.exemplars) {
    const double pixels = static_cast<double>(exemplar.size.width) * exemplar.size.height;
    in += pixels * channels;
    usable += exemplar.mask ? pixels : 0;
  }
  const double out = static_cast<double>(request.size.width) * request.size.height * channels;
  const double sources = static_cast<double>(request.size.width) * request.size.height;
  return {4 * (in + usable + out) + sizeof(Source) * sources, {.shared = 5e-9 * out}};
}

}  // namespace gramloom
