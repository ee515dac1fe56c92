#pragma once

#include <oneapi/dnnl/dnnl.hpp>

namespace gramloom {

/// What differs between oneDNN 2 (Debian 12) and 3 (Debian 13): how primitives are described.

/// Channels in a block: 16 where the processor has AVX-512, else 8.
inline int channel_block() {
  static const bool wide = dnnl::get_effective_cpu_isa() >= dnnl::cpu_isa::avx512_core;
  return wide ? 16 : 8;
}

struct ConvolutionShape {
  dnnl::memory::desc input, weights, bias, output;  // bias: of no dimensions where there is none
  dnnl::memory::dims stride, dilation, padding;
};

/// max(x, slope · x).
inline void append_relu(dnnl::post_ops& operations, float slope = 0) {
#if DNNL_VERSION_MAJOR >= 3
  operations.append_eltwise(dnnl::algorithm::eltwise_relu, slope, 0.0f);
#else
  operations.append_eltwise(1.0f, dnnl::algorithm::eltwise_relu, slope, 0.0f);
#endif
}

inline dnnl::convolution_forward::primitive_desc describe_forward(
    const dnnl::engine& engine, dnnl::algorithm algorithm, const ConvolutionShape& shape,
    const dnnl::primitive_attr& attributes) {
  constexpr auto training = dnnl::prop_kind::forward_training;
#if DNNL_VERSION_MAJOR >= 3
  return {engine,       training,     algorithm,      shape.input,   shape.weights, shape.bias,
          shape.output, shape.stride, shape.dilation, shape.padding, shape.padding, attributes};
#else
  return {{training, algorithm, shape.input, shape.weights, shape.bias, shape.output, shape.stride,
           shape.dilation, shape.padding, shape.padding},
          attributes,
          engine};
#endif
}

/// Of the gradient with respect to the input. `forward` is a convolution of the same shape.
inline dnnl::convolution_backward_data::primitive_desc describe_backward(
    const dnnl::engine& engine, dnnl::algorithm algorithm, const ConvolutionShape& shape,
    const dnnl::convolution_forward::primitive_desc& forward) {
#if DNNL_VERSION_MAJOR >= 3
  return {engine,       algorithm,      shape.input,   shape.weights, shape.output,
          shape.stride, shape.dilation, shape.padding, shape.padding, forward};
#else
  return {{algorithm, shape.input, shape.weights, shape.output, shape.stride, shape.dilation,
           shape.padding, shape.padding},
          engine,
          forward};
#endif
}

}  // namespace gramloom
