#include "classic/histogram.h"

#include <algorithm>
#include <cstdint>

#include "classic/check_input.h"
#include "core/threads.h"

namespace gramloom {

Texture synthesise(const HistogramParams&, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_input(exemplar, target);
  const auto channels = static_cast<std::size_t>(exemplar.channels);
  const auto colours = static_cast<std::uint32_t>(exemplar.pixels.size() / channels);
  Image result(target.size, exemplar.channels);
  control.step(0, 1);
  parallel_for(result.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      Random row = random.stream(static_cast<std::uint64_t>(y));
      for (int x = 0; x < result.width; ++x)
        std::copy_n(exemplar.pixels.data() + row.below(colours) * channels, channels,
                    result.at(x, y));
    }
  });
  control.step(1, 1);
  return {std::move(result), {}};
}

Cost estimate(const HistogramParams&, Size exemplar, int channels, const Target& target) {
  const double in = static_cast<double>(exemplar.width) * exemplar.height * channels;
  const double out = static_cast<double>(target.size.width) * target.size.height * channels;
  return {4 * (in + out), 5e-9 * out};
}

}  // namespace gramloom
