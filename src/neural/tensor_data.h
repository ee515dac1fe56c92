#pragma once

#include <ATen/ATen.h>

#include "io/safetensors.h"

namespace gramloom::neural {

/// Tensors as files hold them, and back: copies, as floats.
inline TensorData to_data(const at::Tensor& tensor) {
  const at::Tensor values = tensor.detach().to(at::kFloat).contiguous();
  const float* first = values.data_ptr<float>();
  return {values.sizes().vec(), {first, first + values.numel()}};
}

inline at::Tensor to_tensor(const TensorData& data) {
  return at::from_blob(const_cast<float*>(data.values.data()), data.shape, at::kFloat).clone();
}

}  // namespace gramloom::neural
