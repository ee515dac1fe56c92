#pragma once

#include <vector>

#include "core/image.h"
#include "core/random.h"
#include "core/request.h"

namespace gramloom {

/// The share of an exemplar's sides that fades out where a larger texture is made of it.
inline constexpr double usual_fade = 0.1;

/// A texture with the exemplar's spectrum and random phases, in the exemplar's range: see
/// PhaseParams for the papers and departures.
Image random_phase_texture(const Image& exemplar, Size size, Tile tile, double fade, Random random);

/// The same of several exemplars, of which parts may be masked: a Gaussian texture with the mean
/// and the covariance of their mixture, each weighed by `weights` (as Target::weights; empty: by
/// their usable pixels). Each exemplar has noise of its own, times the root of its share.
Image random_phase_texture(const std::vector<Exemplar>& exemplars, const Image& weights, Size size,
                           Tile tile, double fade, Random random);

/// The periodic component of each channel of an image (Moisan 2011): the same mean, and opposite
/// edges that meet.
Image periodic_component(const Image& image);

/// The image whose spectrum has the moduli of the spot's and random phases: the method's core,
/// without any change of size or range. Means stay.
Image random_phase_noise(const Image& spot, Random random);

}  // namespace gramloom
