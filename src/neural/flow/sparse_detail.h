#pragma once

#include "core/image.h"

namespace gramloom::neural {

/// How much of a picture is a few thin lines or dots on a calm ground: the absolute skewness of its
/// values times the part of their variance that is lost at a quarter of its size; 0 if it is flat.
/// White veins on black marble have 1.6, a thin weave 0.9, grass, stones, leaves and water at most
/// 0.5.
double sparse_detail(const Image& image);

/// From here on patch flow matching loses what little there is: a mean of patches has no thin line.
inline constexpr double too_sparse_for_flow = 0.85;

}  // namespace gramloom::neural
