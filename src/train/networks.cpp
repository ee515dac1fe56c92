#include "train/networks.h"

#include <cmath>

namespace gramloom::train {

namespace {

namespace nn = torch::nn;

// Zeros for biases, and for weights normal numbers that keep the variance of what goes through
// (He, Zhang, Ren, Sun 2015).
void start(nn::Conv2dImpl& convolution) {
  nn::init::kaiming_normal_(convolution.weight, leaky_slope);
  nn::init::zeros_(convolution.bias);
}

}  // namespace

at::Tensor padded(const at::Tensor& values, int width, Border border) {
  const nn::functional::PadFuncOptions options({width, width, width, width});
  if (border == Border::wraps)
    return nn::functional::pad(values,
                               nn::functional::PadFuncOptions(options).mode(torch::kCircular));
  return nn::functional::pad(values, nn::functional::PadFuncOptions(options).mode(torch::kReflect));
}

at::Tensor upsampled(const at::Tensor& picture, Border border) {
  const std::vector<double> twice{2, 2};
  const at::Tensor large =
      at::upsample_bilinear2d(padded(picture, 1, border), at::OptionalIntArrayRef(), false, twice);
  return large.slice(2, 2, large.size(2) - 2).slice(3, 2, large.size(3) - 2);
}

LevelNetImpl::LevelNetImpl(const GeneratorDescription& description, int level) {
  const GeneratorLevel& shape = description.levels[static_cast<std::size_t>(level)];
  const auto materials = static_cast<std::int64_t>(description.materials.size());
  noise_channels = shape.noise;
  register_module("layers", layers);
  for (int i = 0; i < shape.layers; ++i) {
    nn::Conv2d layer(
        nn::Conv2dOptions(i == 0 ? inputs_of(description, level) : shape.hidden, shape.hidden, 3));
    start(*layer);
    layers->push_back(layer);
  }
  out =
      register_module("out", nn::Conv2d(nn::Conv2dOptions(shape.hidden, description.channels, 1)));
  // Finer levels begin close to what they are given.
  nn::init::normal_(out->weight, 0, (level == 0 ? 1.0 : 0.1) / std::sqrt(shape.hidden));
  nn::init::zeros_(out->bias);
  if (materials == 1) return;
  register_module("scales", scales);
  register_module("shifts", shifts);
  for (int i = 0; i < shape.layers; ++i) {
    for (auto& list : {&scales, &shifts}) {
      const at::Tensor values = 0.1 * at::randn({materials, shape.hidden});
      (*list)->append(values.set_requires_grad(true));  // a list asks for no gradients itself
    }
  }
  out_shifts = register_parameter("out_shifts", torch::zeros({materials, description.channels}));
}

at::Tensor LevelNetImpl::forward(const at::Tensor& coarser, const at::Tensor& noise,
                                 const at::Tensor& shares, Border border) {
  const auto as_channels = [&](const at::Tensor& of_materials) {
    return shares.matmul(of_materials).view({1, -1, 1, 1});
  };
  const bool mixed = out_shifts.defined();
  at::Tensor values = coarser.defined() ? at::cat({coarser, noise}, 1) : noise;
  for (std::size_t i = 0; i < layers->size(); ++i) {
    at::Tensor next = layers[i]->as<nn::Conv2d>()->forward(padded(values, 1, border));
    if (mixed) next = next * (1 + as_channels(scales[i])) + as_channels(shifts[i]);
    next = at::leaky_relu(next, leaky_slope);
    values = i == 0 ? next : (values + next) * std::sqrt(0.5);
  }
  at::Tensor added = out->forward(values);
  if (mixed) added = added + as_channels(out_shifts);
  return coarser.defined() ? coarser + added : added;
}

NormalisedConvolutionImpl::NormalisedConvolutionImpl(int inputs, int outputs, int kernel) {
  nn::Conv2d plain(nn::Conv2dOptions(inputs, outputs, kernel));  // for how it begins
  weight = register_parameter("weight", plain->weight.detach().clone());
  bias = register_parameter("bias", plain->bias.detach().clone());
  left = register_buffer("left", at::randn({outputs}));
  right = register_buffer("right", at::randn({inputs * kernel * kernel}));
  const torch::NoGradGuard no_gradients;
  const at::Tensor matrix = weight.flatten(1);
  for (int i = 0; i < 15; ++i) {
    right.copy_(nn::functional::normalize(matrix.t().mv(left),
                                          nn::functional::NormalizeFuncOptions().dim(0)));
    left.copy_(
        nn::functional::normalize(matrix.mv(right), nn::functional::NormalizeFuncOptions().dim(0)));
  }
}

at::Tensor NormalisedConvolutionImpl::forward(const at::Tensor& input) {
  const at::Tensor matrix = weight.flatten(1);
  at::Tensor u, v;
  {
    const torch::NoGradGuard no_gradients;
    if (is_training()) {
      right.copy_(nn::functional::normalize(matrix.t().mv(left),
                                            nn::functional::NormalizeFuncOptions().dim(0)));
      left.copy_(nn::functional::normalize(matrix.mv(right),
                                           nn::functional::NormalizeFuncOptions().dim(0)));
    }
    u = left.clone();
    v = right.clone();
  }
  return at::conv2d(input, weight / u.dot(matrix.mv(v)), bias);
}

DiscriminatorImpl::DiscriminatorImpl(int channels, int hidden, int layer_count)
    : count(layer_count) {
  register_module("layers", layers);
  for (int i = 0; i < count; ++i)
    layers->push_back(NormalisedConvolution(i == 0 ? channels : hidden, hidden, 3));
  layers->push_back(NormalisedConvolution(hidden, 1, 1));
}

at::Tensor DiscriminatorImpl::forward(const at::Tensor& picture, bool wraps) {
  at::Tensor values = wraps ? padded(picture, count, Border::wraps) : picture;
  // A leaky ReLU lets pass less than it gets; 1.4 makes up for it, as no weight can.
  for (int i = 0; i < count; ++i)
    values = at::leaky_relu(
                 layers[static_cast<std::size_t>(i)]->as<NormalisedConvolution>()->forward(values),
                 leaky_slope) *
             1.4;
  return layers[static_cast<std::size_t>(count)]->as<NormalisedConvolution>()->forward(values);
}

}  // namespace gramloom::train
