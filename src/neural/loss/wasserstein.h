#pragma once

#include <ATen/ATen.h>

#include "core/random.h"

namespace gramloom::neural {

/// Unit vectors to project on, evenly spread over all directions: (count, length), floats.
at::Tensor random_directions(Random random, std::int64_t count, std::int64_t length);

/// Puts each row of (rows, values), contiguous floats, into ascending order.
void sort_rows(at::Tensor& rows);

/// The mean distance between the values of each row and those of the same row of `target`, which is
/// sorted, when each value goes to the one of its own rank: the Wasserstein distance W₁ in one
/// dimension, averaged over the rows. Where the sides have different numbers of values, ranks are
/// relative, and values between two of the target are interpolated.
/// `rows`, contiguous floats, is overwritten by `weight` times the gradient.
double wasserstein(at::Tensor& rows, const at::Tensor& target, double weight = 1);

/// The mean distance of each row's values from their mean, summed over the rows: in an order that
/// does not depend on the threads.
double distance_from_mean(const at::Tensor& rows);

}  // namespace gramloom::neural
