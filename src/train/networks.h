#pragma once

#include <torch/torch.h>

#include "learnt/generator_model.h"

namespace gramloom::train {

/// How a picture goes on beyond its border.
enum class Border { wraps, mirrors };

/// `values` (batch, channels, height, width) with `width` pixels more on each side.
at::Tensor padded(const at::Tensor& values, int width, Border border);

/// A picture twice as large, linearly, each pixel's centre in the middle of four.
at::Tensor upsampled(const at::Tensor& picture, Border border);

/// One level of a generator (learnt/generator_model.h). Its parameters have the names of the
/// model's tensors, without "levels.K.".
struct LevelNetImpl : torch::nn::Module {
  LevelNetImpl(const GeneratorDescription& description, int level);
  /// The level's picture (batch, channels, height, width): `coarser` is of the same size, and
  /// undefined on the first level. `shares`: of the materials, 1 in all.
  at::Tensor forward(const at::Tensor& coarser, const at::Tensor& noise, const at::Tensor& shares,
                     Border border);

  int noise_channels;
  torch::nn::ModuleList layers;
  torch::nn::ParameterList scales, shifts;  // of several materials
  torch::nn::Conv2d out = nullptr;
  at::Tensor out_shifts;
};
TORCH_MODULE(LevelNet);

/// A convolution whose weights are divided by their largest singular value, by one step of power
/// iteration a call (Miyato, Kataoka, Koyama, Yoshida 2018, "Spectral normalization for generative
/// adversarial networks", algorithm 1).
struct NormalisedConvolutionImpl : torch::nn::Module {
  NormalisedConvolutionImpl(int inputs, int outputs, int kernel);
  at::Tensor forward(const at::Tensor& input);

  at::Tensor weight, bias, left, right;  // singular vectors, as far as they are known
};
TORCH_MODULE(NormalisedConvolution);

/// How real each patch of (2 · layers + 1)² pixels looks.
struct DiscriminatorImpl : torch::nn::Module {
  DiscriminatorImpl(int channels, int hidden, int layers);
  at::Tensor forward(const at::Tensor& picture, bool wraps);

  int count;
  torch::nn::ModuleList layers;
};
TORCH_MODULE(Discriminator);

}  // namespace gramloom::train
