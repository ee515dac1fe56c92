#include "train/inference_net.h"

#include <cmath>

namespace gramloom::train {

namespace {

namespace nn = torch::nn;

// One pixel more at both ends of an axis.
at::Tensor padded(const at::Tensor& values, std::int64_t axis, bool wraps) {
  const std::int64_t length = values.size(axis);
  const at::Tensor first = values.slice(axis, 0, 1);
  const at::Tensor last = values.slice(axis, length - 1, length);
  return wraps ? at::cat({last, values, first}, axis) : at::cat({first, values, last}, axis);
}

at::Tensor padded(const at::Tensor& values, Tile wraps) {
  return padded(padded(values, 3, tiles_x(wraps)), 2, tiles_y(wraps));
}

at::Tensor enlarged(const at::Tensor& values, Size size, Tile wraps) {
  const std::vector<double> twice{2, 2};
  const at::Tensor large =
      at::upsample_bilinear2d(padded(values, wraps), at::OptionalIntArrayRef(), false, twice);
  return large.slice(2, 2, 2 + size.height).slice(3, 2, 2 + size.width);
}

// Normal numbers that keep the variance of what goes through a ReLU, which a SiLU resembles (He,
// Zhang, Ren, Sun 2015), and zeros for biases.
template <class Layer>
void start_like_relu(Layer& layer) {
  nn::init::kaiming_normal_(layer->weight, 0, torch::kFanIn, torch::kReLU);
  nn::init::zeros_(layer->bias);
}

}  // namespace

InferenceNetImpl::InferenceNetImpl(const InferenceDescription& description)
    : sizes(inference_sizes(description)), wraps(description.wraps) {
  const int values = description.pose_hidden;
  const Size smallest = sizes.front();
  register_module("pose", pose);
  register_module("layers", layers);
  for (const auto inputs :
       {static_cast<std::int64_t>(description.pose.size()), static_cast<std::int64_t>(values)}) {
    nn::Linear layer(inputs, values);
    start_like_relu(layer);
    pose->push_back(layer);
  }
  start = register_module("start", nn::Linear(values, std::int64_t{description.hidden.front()} *
                                                          smallest.width * smallest.height));
  start_like_relu(start);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    nn::Conv2d layer(nn::Conv2dOptions(description.hidden[k], channels_after(description, k), 3));
    start_like_relu(layer);
    layers->push_back(layer);
  }
  out = register_module(
      "out", nn::Conv2d(nn::Conv2dOptions(description.hidden.back(), description.channels, 3)));
  // It begins close to the mean picture.
  nn::init::normal_(out->weight, 0, 0.1 / std::sqrt(9.0 * description.hidden.back()));
  nn::init::zeros_(out->bias);
}

at::Tensor InferenceNetImpl::forward(const at::Tensor& poses) {
  at::Tensor values = poses;
  for (std::size_t i = 0; i < pose->size(); ++i)
    values = at::silu(pose[i]->as<nn::Linear>()->forward(values));
  values = start->forward(values).view({poses.size(0), -1, sizes[0].height, sizes[0].width});
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    values = at::silu(layers[k]->as<nn::Conv2d>()->forward(padded(values, wraps)));
    if (k + 1 < sizes.size()) values = enlarged(values, sizes[k + 1], wraps);
  }
  return out->forward(padded(values, wraps));
}

InferenceLoss inference_loss(const at::Tensor& made, const at::Tensor& real, Tile wraps) {
  const at::Tensor difference = made - real;
  InferenceLoss loss{difference.square().mean(), at::zeros({}, difference.options())};
  for (const auto& [axis, wrap] : {std::pair{2, tiles_y(wraps)}, std::pair{3, tiles_x(wraps)}}) {
    const std::int64_t length = difference.size(axis);
    if (wrap)
      loss.slopes = loss.slopes + (difference - difference.roll(1, axis)).square().mean();
    else if (length > 1)
      loss.slopes =
          loss.slopes + (difference.slice(axis, 1, length) - difference.slice(axis, 0, length - 1))
                            .square()
                            .mean();
  }
  return loss;
}

}  // namespace gramloom::train
