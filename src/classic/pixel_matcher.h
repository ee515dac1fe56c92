#pragma once

#include <vector>

#include "classic/pixel.h"
#include "classic/pixel_direction.h"
#include "classic/pixel_features.h"
#include "classic/pixel_guide_cells.h"
#include "classic/pixel_match.h"
#include "classic/pixel_plane.h"

namespace gramloom::pixel {

/// What finds the best source for a pixel at one level.
struct Matcher {
  const Level& level;
  const Aim& aim;
  const PixelParams& params;
  Projection projection;
  std::vector<Feature> features;
  std::vector<Point> similar;  // [sample][candidates]
  Reference reference;         // for the exact search
  std::vector<float> weights;
  float all_weights = 0;
  GuideCells cells;

  /// Keeps the addresses of all but the random numbers.
  Matcher(const Level& level_, const Aim& aim_, const PixelParams& params_, Random random);

  /// `random`: of this pixel in this pass.
  Point best(const Canvas& canvas, const Plane& plane, int x, int y, Random random) const {
    return params.search == PixelSearch::exact ? best_of_all(plane, x, y)
                                               : best_of_coherent(canvas, plane, x, y, random);
  }
  /// By features, of all samples.
  Point nearest(const Plane& plane, int x, int y) const;

 private:
  Point best_of_coherent(const Canvas& canvas, const Plane& plane, int x, int y,
                         Random random) const;
  Point best_of_all(const Plane& plane, int x, int y) const;
  bool guides(int x, int y) const { return !aim.guide.empty() && aim.is_made(aim.index(x, y)); }
};

}  // namespace gramloom::pixel
