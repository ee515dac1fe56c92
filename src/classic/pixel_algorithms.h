#pragma once

#include "classic/pixel.h"
#include "classic/pixel_canvas.h"

namespace gramloom::pixel {

/// Lefebvre & Hoppe 2005, "Parallel controllable texture synthesis": coarse to fine; at each level
/// the pixels' sources are refined, displaced (jitter) and corrected: each pixel takes, of the
/// samples that its neighbours' sources and the samples like those suggest (k-coherence, Tong et
/// al. 2002), the one whose neighbourhood is nearest to the pixel's own.
Canvas lefebvre_hoppe(const PixelParams& params, const Image& exemplar, const Target& target,
                      Random random, const Control& control);

Canvas wei_levoy(const PixelParams& params, const Image& exemplar, const Target& target,
                 Random random, const Control& control);

Canvas efros_leung(const PixelParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control);

}  // namespace gramloom::pixel
