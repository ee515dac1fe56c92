#include "classic/pixel_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gramloom::pixel {
namespace {

/// Samples with the wanted guide that are tried for each pixel, beside those that continue others.
constexpr int drawn_by_guide = 8;

}  // namespace

Matcher::Matcher(const Level& level_, const Aim& aim_, const PixelParams& params_, Random random)
    : level(level_),
      aim(aim_),
      params(params_),
      projection(make_projection(level, params.radius, random.stream(0))),
      features(make_features(level, projection)),
      similar(similar_samples(level, features, params.candidates, distance_apart(level),
                              random.stream(1))),
      reference(level, params.search == PixelSearch::exact ? params.radius : 0),
      weights(gaussian_weights(params.radius)) {
  for (const float weight : weights) all_weights += weight;
  if (!aim.guide.empty()) cells = GuideCells(level, random.stream(2));
}

Point Matcher::best_of_coherent(const Canvas& canvas, const Plane& plane, int x, int y,
                                Random random) const {
  const Feature wanted = plane.feature(projection, x, y);
  const auto candidates = static_cast<std::size_t>(params.candidates);
  std::array<Point, 9 * 16> tried;
  auto end = tried.begin();
  Point best = canvas.at(x, y);
  float least = INFINITY;
  const bool guided = guides(x, y);
  const auto consider = [&](Point p) {
    const int sample = level.index(p);
    if (!level.may_use(sample)) return;
    float distance = squared_distance(wanted, features[static_cast<std::size_t>(sample)]);
    if (guided) distance += all_weights * aim.guide_error(level, sample, x, y);
    if (distance < least) {
      least = distance;
      best = p;
    }
  };
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      int near_x = x + dx, near_y = y + dy;
      if (!canvas.wrap(near_x, near_y)) continue;
      const auto source = static_cast<std::size_t>(level.index(canvas.at(near_x, near_y)));
      for (std::size_t i = source * candidates; i < (source + 1) * candidates; ++i) {
        const Point p{similar[i].x - dx * level.step, similar[i].y - dy * level.step};
        if (!level.contains(p) || std::find(tried.begin(), end, p) != end) continue;
        *end++ = p;
        consider(p);
      }
    }
  if (guided)
    for (int i = 0; i < drawn_by_guide; ++i)
      consider(level.point(cells.draw(aim.guide.at(x, y), random)));
  return best;
}

Point Matcher::best_of_all(const Plane& plane, int x, int y) const {
  std::vector<Known> neighbourhood;
  auto weight = weights.begin();
  for (int dy = -params.radius; dy <= params.radius; ++dy)
    for (int dx = -params.radius; dx <= params.radius; ++dx)
      neighbourhood.push_back({reference.offset(dx, dy), *weight++, plane.at(x + dx, y + dy)});
  auto errors = reference.errors(neighbourhood);
  add_direction(level, aim, x, y, all_weights, errors);
  return level.point(
      static_cast<int>(std::min_element(errors.begin(), errors.end()) - errors.begin()));
}

Point Matcher::nearest(const Plane& plane, int x, int y) const {
  const Feature wanted = plane.feature(projection, x, y);
  int best = 0;
  float least = INFINITY;
  for (int i = 0; i < level.count(); ++i) {
    const float distance = squared_distance(wanted, features[static_cast<std::size_t>(i)]);
    if (distance < least && level.may_use(i)) {
      least = distance;
      best = i;
    }
  }
  return level.point(best);
}

}  // namespace gramloom::pixel
