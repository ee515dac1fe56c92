#pragma once

#include <ATen/ATen.h>
#include <c10/core/GradMode.h>
#include <torch/csrc/autograd/autograd.h>

namespace gramloom::neural {

/// f(picture) is a scalar, made of what LibTorch can derive; adds weight times its gradient and
/// returns it.
template <class F>
double add_gradient(const at::Tensor& picture, double weight, at::Tensor& gradient, F&& f) {
  const c10::AutoGradMode gradients(true);
  const at::Tensor x = picture.detach().requires_grad_(true);
  const at::Tensor value = f(x);
  gradient.add_(torch::autograd::grad({value}, {x})[0], weight);
  return value.template item<double>();
}

}  // namespace gramloom::neural
