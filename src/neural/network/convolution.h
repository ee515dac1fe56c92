#pragma once

#include "neural/network/feature_maps.h"

namespace gramloom::neural {

struct ConvolutionState;  // a torch::CustomClassHolder, shared with the graphs in flight

/// A convolution whose weights never change, optionally followed by ReLU. In float32 it calls
/// oneDNN, LibTorch's own convolution library, directly: with Winograd's algorithm for 3×3 kernels
/// where the processor has it (2.5 times faster than what LibTorch asks for), ReLU in the same
/// pass, no input kept for the gradient, and no change of memory layout between layers. In double
/// it is LibTorch's convolution, for checks of gradients.
/// Winograd's F(4×4, 3×3) rounds about ten times as coarsely as the direct sum: 1e-6 of the
/// largest value.
class Convolution {
 public:
  /// weights: (outputs, inputs, kernel, kernel), odd kernel; bias: (outputs) or undefined.
  Convolution(at::Tensor weights, at::Tensor bias, std::int64_t dilation = 1);
  ~Convolution();
  Convolution(Convolution&&) noexcept;
  Convolution& operator=(Convolution&&) noexcept;

  /// Positions that an edge needs on each side to keep the size.
  std::int64_t radius() const;

  FeatureMaps operator()(const FeatureMaps& maps, Edges edges, bool relu) const;
  /// The same from (inputs, height, width), for pictures of few channels.
  FeatureMaps operator()(const at::Tensor& planes, Edges edges, bool relu) const;

 private:
  c10::intrusive_ptr<ConvolutionState> state_;
};

}  // namespace gramloom::neural
