#pragma once

#include <ATen/ATen.h>

#include "core/image.h"

namespace gramloom::neural {

/// Each channel less its mean.
at::Tensor centred(const at::Tensor& planes);

/// The mean product of each channel with itself shifted by (dy, dx), for dy in [0, lags.height) and
/// dx in (−lags.width, lags.width): (channels, lags.height, 2 lags.width − 1), dx = 0 in the
/// middle. On an axis that wraps all positions count, on others those whose partner is inside.
/// Differentiable.
at::Tensor autocorrelation(const at::Tensor& planes, Size lags, Tile wraps);

/// Lags as autocorrelation() gives them, at their places on a torus of that size, with those of
/// negative dy by symmetry.
at::Tensor on_torus(const at::Tensor& lags, Size size);

/// 1 / Σ, or 0 where nothing is there.
double inverse_of_sum(const at::Tensor& squares);

}  // namespace gramloom::neural
