#pragma once

#include "neural/network/rows.h"

namespace gramloom::neural {

/// (channels, height, width) at another size: cubic (Keys 1981, a = −½) when enlarging, the same
/// kernel widened by the factor when shrinking. Interpolates across edges that wrap; beyond others
/// lies the edge position's value. A constant stays constant. Linear, with its gradient.
at::Tensor resample(const at::Tensor& planes, Size size, Tile tile);
/// `rows` of that picture. It has at least rows_to_resample() those.
HeldRows resample(const HeldRows& picture, Size size, Rows rows, Tile tile);
/// The rows, of `height` in all, that `rows` of `own_height` are made of.
Rows rows_to_resample(Rows rows, std::int64_t height, std::int64_t own_height, Tile tile);

/// `rows` of feature maps at a smaller size, by overlapping triangular windows: the transpose of
/// enlarging the smaller ones bilinearly. Boxes side by side would leave their edges in a
/// synthesis. It has at least rows_to_shrink() those.
HeldRows shrink(const HeldRows& maps, Size size, Rows rows, Tile tile);
/// Likewise.
Rows rows_to_shrink(Rows rows, std::int64_t height, std::int64_t own_height, Tile tile);

}  // namespace gramloom::neural
