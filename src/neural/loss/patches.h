#pragma once

#include <ATen/ATen.h>

#include "core/image.h"

namespace gramloom::neural {

/// Every k × k patch of a picture (channels, height, width) as a number: its product with each of
/// the filters (filters, channels, k, k). The result is (filters, positions), row by row; on an
/// axis that `wraps` tiles patches go on across the edge, on others they lie inside the picture.
/// Throws Error when no patch fits.
at::Tensor project_patches(const at::Tensor& planes, const at::Tensor& filters, Tile wraps);

/// The transpose: adds to `planes` what a gradient (filters, positions) of project_patches() is for
/// the picture.
void spread_patches(const at::Tensor& gradient, const at::Tensor& filters, Tile wraps,
                    at::Tensor& planes);

}  // namespace gramloom::neural
