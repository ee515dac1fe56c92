#pragma once

#include "classic/pixel.h"
#include "classic/pixel_canvas.h"
#include "classic/pixel_direction.h"
#include "classic/pixel_match.h"

namespace gramloom::pixel {

// The three ways to choose each pixel's source; see PixelParams for the papers and departures.
Canvas lefebvre_hoppe(const PixelParams& params, const Task& task, Random random,
                      const Control& control);
Canvas wei_levoy(const PixelParams& params, const Task& task, Random random,
                 const Control& control);
Canvas efros_leung(const PixelParams& params, const Task& task, Random random,
                   const Control& control);

/// The samples like each sample of a level: itself and candidates − 1 others, at least a twentieth
/// of the exemplar apart. Shape [sample][candidates].
struct Similar {
  std::size_t candidates;
  std::vector<Point> samples;

  /// The samples like p.
  std::span<const Point> operator()(const Level& level, Point p) const {
    return std::span(samples).subspan(static_cast<std::size_t>(level.index(p)) * candidates,
                                      candidates);
  }
};
Similar make_similar(const PixelParams& params, const Level& level, Random random);

/// The samples that continue what is known about pixel (x, y): of each known pixel in its 3×3
/// neighbourhood the sources like its own (k-coherence: Ashikhmin 2001; Tong et al. 2002), less its
/// offset from (x, y). Each once.
std::vector<Point> coherent_candidates(const Canvas& canvas, const std::vector<bool>& known,
                                       const Level& level, const Similar& similar, int x, int y);

}  // namespace gramloom::pixel
