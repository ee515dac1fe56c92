#pragma once

#include <torch/torch.h>

#include <array>
#include <memory>
#include <vector>

#include "train/generator_training.h"
#include "train/lesson_pictures.h"
#include "train/networks.h"
#include "train/optimiser_state.h"

namespace gramloom::train {

/// The generator under training: its levels so far.
struct GeneratorNets {
  std::vector<LevelNet> levels;

  /// Level `level`'s pictures, `batch` of this size on that level: noise from LibTorch's random
  /// numbers, edges that wrap, gradients of that level alone.
  at::Tensor picture(int level, int batch, Size size, const at::Tensor& shares);
  /// What level `level` is given: the coarser level's picture made as large; undefined on the
  /// first.
  at::Tensor coarser_picture(int level, int batch, Size size, const at::Tensor& shares);
};

/// Uniform noise of variance 1 for a level.
at::Tensor noise_like(const LevelNet& net, int batch, Size size);

/// The training of one level: a step at a time.
class GeneratorStage {
 public:
  /// `before`: the discriminators of the coarser level, which those of this one begin as.
  GeneratorStage(const GeneratorLesson& lesson, const LessonPictures& pictures, GeneratorNets& nets,
                 int level, std::vector<Discriminator> before);

  int steps() const { return steps_; }
  /// Step `step`; its random numbers depend on the seed, the level and the step alone. Returns the
  /// terms that it saw.
  std::vector<Term> step(int step);
  std::vector<Discriminator> discriminators() const { return discriminators_; }

  void keep(Tensors& tensors);
  void restore(const Tensors& tensors);

 private:
  at::Tensor generated(int material, int patch_size);
  at::Tensor reconstructed(int material, int patch_size);
  float train_discriminator(int material, const at::Tensor& picture, const at::Tensor& coarser);
  at::Tensor judged(int material, const at::Tensor& picture, const at::Tensor& coarser, bool wraps);

  const GeneratorLesson& lesson_;
  const LessonPictures& pictures_;
  GeneratorNets& nets_;
  int level_, steps_, batch_;
  double adversary_, reconstruction_;
  std::vector<at::Tensor> parameters_;
  std::unique_ptr<torch::optim::Adam> optimiser_, adversary_optimiser_;
  std::array<float, 4> latest_{};              // values of the terms, each when last seen
  std::vector<Discriminator> discriminators_;  // one a material; none: no adversary
};

}  // namespace gramloom::train
