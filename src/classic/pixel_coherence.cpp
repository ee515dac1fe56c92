#include <algorithm>

#include "classic/pixel_algorithms.h"
#include "classic/pixel_features.h"

namespace gramloom::pixel {

Similar make_similar(const PixelParams& params, const Level& level, Random random) {
  const Projection projection = make_projection(level, params.radius, random.stream(0));
  return {static_cast<std::size_t>(params.candidates),
          similar_samples(level, make_features(level, projection), params.candidates,
                          distance_apart(level), random.stream(1))};
}

std::vector<Point> coherent_candidates(const Canvas& canvas, const std::vector<bool>& known,
                                       const Level& level, const Similar& similar, int x, int y) {
  std::vector<Point> found;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      int near_x = x + dx, near_y = y + dy;
      if (!canvas.wrap(near_x, near_y) || !known[canvas.index(near_x, near_y)]) continue;
      for (const Point like : similar(level, canvas.at(near_x, near_y))) {
        const Point p{like.x - dx * level.step, like.y - dy * level.step};
        if (level.contains(p) && level.may_use(level.index(p)) &&
            std::find(found.begin(), found.end(), p) == found.end())
          found.push_back(p);
      }
    }
  return found;
}

}  // namespace gramloom::pixel
