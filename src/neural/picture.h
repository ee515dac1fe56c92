#pragma once

#include <ATen/ATen.h>

#include "core/image.h"
#include "signal/colour_pca.h"

namespace gramloom::neural {

/// (channels, height, width), float.
at::Tensor to_planes(const Image& image);
Image to_image(const at::Tensor& planes);

}  // namespace gramloom::neural
