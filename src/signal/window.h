#pragma once

#include <vector>

namespace gramloom {

/// A window over an axis of `length` samples: 1 inside, and over a share `fade` of the length at
/// each end a raised cosine down to 0. With a fade of 1/2 it is the window of von Hann, sin².
std::vector<double> raised_cosine(int length, double fade);

/// `window` scaled so that the sum of its squares is `energy`.
std::vector<float> scaled_to_energy(const std::vector<double>& window, double energy);

}  // namespace gramloom
