#pragma once

#include <torch/torch.h>

#include "learnt/inference_model.h"

namespace gramloom::train {

/// The network of an inference (learnt/inference_model.h). Its parameters have the names of the
/// model's tensors.
struct InferenceNetImpl : torch::nn::Module {
  explicit InferenceNetImpl(const InferenceDescription& description);
  /// Poses (batch, numbers) within −1 … 1; pictures (batch, channels, height, width), of mean 0 and
  /// deviation 1.
  at::Tensor forward(const at::Tensor& poses);

  std::vector<Size> sizes;
  Tile wraps;
  torch::nn::ModuleList pose, layers;
  torch::nn::Linear start = nullptr;
  torch::nn::Conv2d out = nullptr;
};
TORCH_MODULE(InferenceNet);

/// What a made picture differs from the true one: the mean square of values, and `slopes` times
/// that of the differences of neighbours, around the edges too where pictures wrap.
struct InferenceLoss {
  at::Tensor values, slopes;
};
InferenceLoss inference_loss(const at::Tensor& made, const at::Tensor& real, Tile wraps);

}  // namespace gramloom::train
