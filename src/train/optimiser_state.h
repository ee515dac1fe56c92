#pragma once

#include <torch/torch.h>

#include <map>
#include <string>

#include "neural/tensor_data.h"

namespace gramloom::train {

// What an interrupted training needs to go on to the same bytes, as tensors by name.

using Tensors = std::map<std::string, TensorData>;

using neural::to_data;
/// Throws Error for one that is missing or of another shape.
at::Tensor to_tensor(const Tensors& tensors, const std::string& name, at::IntArrayRef shape);

/// All parameters and buffers of a module, as "PREFIX.name"; and back, each of its own shape.
/// Throws Error for one that is missing or of another shape.
void keep(const torch::nn::Module& module, const std::string& prefix, Tensors& tensors);
void restore(torch::nn::Module& module, const std::string& prefix, const Tensors& tensors);

/// The moments that Adam has of each of its parameters, and its count of steps; and back.
void keep(torch::optim::Adam& optimiser, const std::string& prefix, Tensors& tensors);
void restore(torch::optim::Adam& optimiser, const std::string& prefix, const Tensors& tensors);

}  // namespace gramloom::train
