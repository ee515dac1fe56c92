#include "classic/histogram.h"

#include <cstdint>

#include "core/threads.h"

namespace gramloom {

Texture synthesise(const HistogramParams&, const Request& request, const Control& control) {
  check_request<HistogramParams>(request);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  const auto colours = static_cast<std::uint32_t>(exemplar.pixels.size() /
                                                  static_cast<std::size_t>(exemplar.channels));
  SourceMap source(target.size);
  control.step(0, 1);
  parallel_for(target.size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      Random row = request.random.stream(static_cast<std::uint64_t>(y));
      for (int x = 0; x < target.size.width; ++x) {
        const auto drawn = static_cast<int>(row.below(colours));
        *source.at(x, y) = {drawn % exemplar.width, drawn / exemplar.width};
      }
    }
  });
  control.step(1, 1);
  return texture_of(std::move(source), request.exemplars);
}

Cost estimate(const HistogramParams&, const RequestSize& request) {
  check_request<HistogramParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const double in = static_cast<double>(exemplar.width) * exemplar.height * channels;
  const double out = static_cast<double>(request.size.width) * request.size.height * channels;
  const double sources = static_cast<double>(request.size.width) * request.size.height;
  return {4 * (in + out) + sizeof(Source) * sources, 5e-9 * out};
}

}  // namespace gramloom
