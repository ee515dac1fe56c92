#pragma once

#include <cstddef>

#include "core/image.h"

namespace gramloom {

/// Throws Error with the place of the first NaN or infinite value.
void check_finite(const Image& image);
/// Of some rows of a picture, interleaved, of which `first_row` is the first.
void check_finite(const float* values, std::size_t count, int width, int channels, int first_row);

/// Throws Error for a value of 1e30 or more, either way: no brightness and no height, but a mark
/// for missing data (−3.4e38 in maps of terrain), beside which all others would look alike.
void check_no_data(const Image& image);

}  // namespace gramloom
