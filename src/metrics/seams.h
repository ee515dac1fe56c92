#pragma once

#include "core/image.h"

namespace gramloom {

/// How visible the seam is where the right edge meets the left one (`right_edge`), or the lower the
/// upper one: the mean step from pixel to pixel across it (root of the summed squares over the
/// channels), divided by the same across the line inside the image that is stronger than 95 % of
/// all parallel to it. Up to 1 no line stands out; a hard seam comes to several. 0 where the seam
/// is perfectly smooth, or the axis is a single pixel; a step in an image without any inside counts
/// as `seam_limit`, the largest value.
double seam_visibility(const Image& image, bool right_edge);

inline constexpr double seam_limit = 1000;

/// How visible the joins of a filled picture are: the mean step across the outline of what was made
/// (`mask`: 1), divided by the same across the outline laid elsewhere over the picture, at the
/// strongest but 5 % of many places. Up to 1 the joins stand out no more than other outlines do. 0
/// where there is no outline.
double join_visibility(const Image& image, const Image& mask);

}  // namespace gramloom
