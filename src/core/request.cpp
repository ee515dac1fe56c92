#include "core/request.h"

#include <algorithm>
#include <utility>

#include "core/surroundings.h"
#include "core/threads.h"

namespace gramloom {

namespace {

// Whether the exemplar is the picture that is filled: by some of its rows.
bool is_filled(const Exemplar& exemplar, const Target& target) {
  constexpr int every = 16;
  if (target.known.empty() || exemplar.image.size() != target.size) return false;
  bool any = false;
  for (int y = 0; y < target.size.height; y += std::min(every, 1 + target.size.height / 64))
    for (int x = 0; x < target.size.width; ++x) {
      if (*target.mask.at(x, y) > 0.5f) continue;
      if (!exemplar.mask.empty() && *exemplar.mask.at(x, y) <= 0.5f) continue;
      any = true;
      if (!std::equal(target.known.at(x, y), target.known.at(x, y) + target.known.channels,
                      exemplar.image.at(x, y)))
        return false;
    }
  return any;
}

}  // namespace

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
      exemplar.filled = is_filled(request.exemplars[i], target);
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
