#pragma once

#include <ATen/ATen.h>

#include <functional>
#include <span>

#include "core/image.h"

namespace gramloom::neural {

/// Adds the gradient of a sum over all patches of a picture (channels, height, width) and all
/// filters (filters, channels, k, k) of a function of their product. `to_slopes(filter, products)`
/// puts the function's derivatives in the products' place. What project_patches() and
/// spread_patches() do one after the other, here in pieces that stay in the cache: the products are
/// never there all at once. The picture must have patches; both are contiguous floats.
void add_slopes(
    const at::Tensor& picture, const at::Tensor& filters, Tile wraps,
    const std::function<void(std::int64_t filter, std::span<float> products)>& to_slopes,
    at::Tensor& gradient);

}  // namespace gramloom::neural
