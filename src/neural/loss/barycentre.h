#pragma once

#include <ATen/ATen.h>

#include <vector>

namespace gramloom::neural {

/// Rows of `count` ascending values: the quantiles of the rows of each of `sorted`, which ascend,
/// averaged by these shares, whose sum is 1: the Wasserstein barycentre in one dimension.
at::Tensor barycentre(const std::vector<at::Tensor>& sorted, const std::vector<float>& shares,
                      std::int64_t count);

}  // namespace gramloom::neural
