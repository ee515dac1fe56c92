#pragma once

#include <torch/torch.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "train/generator_training.h"
#include "train/lesson_pictures.h"
#include "train/networks.h"
#include "train/optimiser_state.h"

namespace gramloom::train {

/// A level's pictures (batch, channels, height, width), and what the level was given: the coarser
/// pictures, made as large. That is undefined on the first level.
struct LevelPictures {
  at::Tensor picture, coarser;
};

/// The generator under training.
struct GeneratorNets {
  std::vector<LevelNet> levels;

  /// Pictures of `level`, of this size there, with edges that wrap; noise from LibTorch's random
  /// numbers; gradients of levels from `first` on.
  LevelPictures pictures(int level, int first, int batch, Size size, const at::Tensor& shares);
};

/// Uniform noise of variance 1 for a level.
at::Tensor noise_like(const LevelNet& net, int batch, Size size);

/// A discriminator, or none, for each material.
using Discriminators = std::vector<Discriminator>;

/// The training of one level: a step at a time.
class GeneratorStage {
 public:
  /// `before`: the discriminators of the coarser level, which those of this one begin as where they
  /// are alike.
  GeneratorStage(const GeneratorLesson& lesson, const LessonPictures& pictures, GeneratorNets& nets,
                 int level, const Discriminators& before);

  int steps() const { return steps_; }
  /// Step `step`; its random numbers depend on the seed, the level and the step alone. Returns the
  /// terms, each as it was last seen.
  std::vector<Term> step(int step);
  const Discriminators& discriminators() const { return discriminators_; }

  /// Calls `work` while the networks have the mean weights.
  void with_means(const std::function<void()>& work);
  /// Gives the networks the mean weights, at the end.
  void take_means();

  void keep(Tensors& tensors);
  void restore(const Tensors& tensors);

 private:
  at::Tensor generated(int material, int patch_size, bool pooled);
  at::Tensor reconstructed(int material, int patch_size);
  at::Tensor distance(const at::Tensor& pictures, const std::vector<at::Tensor>& pyramid,
                      int patch_size, bool pooled) const;
  at::Tensor believed(int material, const LevelPictures& made, const LevelPictures& real,
                      bool wraps);
  at::Tensor judged(int material, const LevelPictures& pictures, bool wraps) const;
  LevelPictures part_of_exemplar(const std::vector<at::Tensor>& pyramid) const;
  void update_means(int step);

  const GeneratorLesson& lesson_;
  GeneratorNets& nets_;
  const std::vector<std::vector<at::Tensor>>& pyramids_;
  int level_, first_, steps_, batch_;
  bool sees_coarser_;  // the discriminator
  double adversary_, reconstruction_;
  std::vector<at::Tensor> parameters_, means_;  // of the levels that are trained
  std::unique_ptr<torch::optim::Adam> optimiser_, adversary_optimiser_;
  Discriminators discriminators_;
  std::array<float, 4> latest_{};  // values of the terms
};

}  // namespace gramloom::train
