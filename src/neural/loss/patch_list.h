#pragma once

#include <ATen/ATen.h>

#include <vector>

#include "core/image.h"
#include "neural/flow/patch_axes.h"

namespace gramloom::neural {

/// The patches at these places of a picture (channels, height, width) of floats as numbers: their
/// product with each of the filters (filters, channels, k, k). The result is (filters, places).
/// Patches go on across all edges. The same bytes for any number of threads.
at::Tensor project_list(const at::Tensor& picture, const at::Tensor& filters,
                        const std::vector<PatchPlace>& places);

/// The transpose: adds to `gradient`, of a picture, what `slopes` (filters, places) are for it. The
/// places are in the order of their rows.
void spread_list(const at::Tensor& slopes, const at::Tensor& filters,
                 const std::vector<PatchPlace>& places, at::Tensor& gradient);

}  // namespace gramloom::neural
