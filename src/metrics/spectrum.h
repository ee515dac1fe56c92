#pragma once

#include "core/image.h"

namespace gramloom {

/// Root mean square, over rings of frequency a third of an octave wide, of the difference in dB
/// between the densities of power (all components together): 0 for equal spectra; 3 dB is a factor
/// of 2. Rings go from 2 periods a side of the smaller image to ½ cycle a pixel; power below -60 dB
/// of the exemplar's is all alike. Of the periodic components (Moisan 2011).
double spectrum_distance(const Image& exemplar, const Image& image);

}  // namespace gramloom
