#include "core/request.h"

#include <algorithm>
#include <utility>

#include "core/surroundings.h"
#include "core/threads.h"

namespace gramloom {

RequestSize size_of(const Request& request) {
  RequestSize result;
  for (const Exemplar& exemplar : request.exemplars)
    result.exemplars.push_back({exemplar.image.size(), exemplar.image.channels,
                                !exemplar.mask.empty(), !exemplar.guide.empty()});
  const Target& target = request.target;
  result.size = target.size;
  result.tile = target.tile;
  result.known = !target.known.empty() || !target.mask.empty();
  if (!target.mask.empty() && target.tile == Tile::none) {
    const Box box = with_surroundings(box_of(target.mask), target.size);
    result.around = box.size();
    for (std::size_t i = 0; i < request.exemplars.size(); ++i) {
      ExemplarSize& exemplar = result.exemplars[i];
      exemplar.filled =  // some rows tell
          is_filled(request.exemplars[i], target, std::min(16, 1 + target.size.height / 64));
      if (exemplar.filled && !has_enough(request.exemplars[i].mask, box)) result.around = {};
    }
  }
  if (!target.mask.empty())
    result.made = static_cast<double>(
                      std::ranges::count_if(target.mask.pixels, [](float v) { return v > 0.5f; })) /
                  static_cast<double>(target.mask.pixels.size());
  result.guide = !target.guide.empty();
  result.weights = !target.weights.empty() && request.exemplars.size() > 1;
  result.turn = !target.turn.empty();
  return result;
}

Image arranged(const SourceMap& sources, const std::vector<Exemplar>& exemplars) {
  const int channels = exemplars.front().image.channels;
  Image result(sources.size, channels);
  parallel_for(result.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y) {
      const Source* source = sources.at(0, y);
      float* to = result.at(0, y);
      for (int x = 0; x < result.width; ++x, ++source, to += channels)
        std::copy_n(exemplars[source->exemplar].image.at(source->x, source->y), channels, to);
    }
  });
  return result;
}

Texture texture_of(SourceMap source, const std::vector<Exemplar>& exemplars) {
  Image image = arranged(source, exemplars);
  return {std::move(image), {}, std::move(source)};
}

}  // namespace gramloom
