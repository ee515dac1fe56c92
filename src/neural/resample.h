#pragma once

#include "neural/feature_maps.h"

namespace gramloom::neural {

/// (channels, height, width) at another size: cubic (Keys 1981, a = −½) when enlarging, the same
/// kernel widened by the factor when shrinking. Interpolates across edges that wrap; beyond others
/// lies the edge position's value. A constant stays constant. Linear, with its gradient.
at::Tensor resample(const at::Tensor& planes, Size size, Tile tile);

/// Feature maps at a smaller size by overlapping triangular windows: the transpose of enlarging the
/// smaller ones bilinearly. Boxes side by side would leave their edges in a synthesis.
FeatureMaps shrink(const FeatureMaps& maps, Size size, Tile tile);

}  // namespace gramloom::neural
