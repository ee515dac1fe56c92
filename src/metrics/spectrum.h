#pragma once

#include <vector>

#include "core/image.h"

namespace gramloom {

/// Root mean square, over rings of frequency up to half an octave wide, of the difference in dB
/// between the densities of power (all components together): 0 for equal spectra; 3 dB is a factor
/// of 2. Rings go from 4 periods a side of the smaller image to ½ cycle a pixel; power below -60 dB
/// of the exemplar's is all alike. Both images fade out towards their edges (Hann's window), so
/// that a regular texture's lines are as wide whether its period divides the side or not.
double spectrum_distance(const std::vector<double>& exemplar, const std::vector<double>& image);

/// What it compares: the density of each ring of a picture of components, −1 where none of its
/// frequencies lies in the ring. `side`: the smallest side of both images.
std::vector<double> ring_densities(const Image& image, int side);

}  // namespace gramloom
