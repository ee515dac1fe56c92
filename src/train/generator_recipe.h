#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// How a generator (learnt/generator_model.h) is trained: a [[model]] of a config. Lists have a
/// number a level, the coarsest first; the last number stands for all finer levels.
///
/// Level after level, with the next coarser one; those below stay as they are. What counts is a sum
/// of
/// - the sliced Wasserstein distance of patches, pooled over the pictures of a batch (Rabin, Peyré,
///   Delon, Bernot 2011; of patches: Elnekave and Weiss 2022), on the level and the next coarser;
/// - an adversary: a small patch discriminator of spectrally normalised convolutions (Miyato et al.
///   2018) with the hinge loss, which on the finest level sees the coarser picture too (Isola et
///   al. 2017): without that edges come out jagged there;
/// - in every other step of levels above the first, the exemplar's own finer level made of its own
///   coarser one: sliced distance and mean absolute difference (Shaham et al. 2019, section 3.2).
/// What is kept is a running mean of the weights (Polyak and Juditsky 1992).
/// The sliced distance alone gives noise: its value is low, and there are no stones.
struct GeneratorRecipe {
  static constexpr std::string_view kind = "generator";
  static constexpr std::string_view summary = "a small network that makes textures of any size";

  std::vector<std::string> exemplars;
  bool blend = false;
  int coarsest_side = 32;
  std::vector<int> hidden{32, 32, 32, 16};
  std::vector<int> layers{6, 4, 3, 3};
  std::vector<int> noise{8, 4, 4, 4};
  std::vector<int> steps{600, 850, 800, 500};
  std::vector<int> batch{4, 2, 1, 1};
  std::vector<int> crop{96, 96, 96, 128};
  double learning_rate = 0.003;
  double coarser_rate = 0.3;
  std::vector<int> patch_size{7, 5};
  int directions = 32;
  double whitening = 0.4;
  std::vector<double> adversary{0.2, 0.15, 0.1, 0.04};
  std::vector<int> adversary_hidden{32, 32, 24, 16};
  std::vector<int> adversary_layers{4, 4, 4, 3};
  std::vector<double> reconstruction{0.3};
  int sample_every = 200;
  int seed = 1;

  static constexpr auto fields() {
    using R = GeneratorRecipe;
    return std::tuple{
        Field{"exemplars", &R::exemplars, "names of the config's that it learns; none: all"},
        Field{"blend", &R::blend, "one model that learns all of them, to mix; or a model for each"},
        Field{"coarsest_side",
              &R::coarsest_side,
              "of the exemplar on the coarsest level, about: at least four pixels a stone",
              "pixels",
              {8, 128}},
        Field{"hidden", &R::hidden, "channels of a level's convolutions", "", {4, 128}},
        Field{"layers", &R::layers, "convolutions of a level", "", {1, 16}},
        Field{"noise", &R::noise, "channels of noise of a level, a multiple of 4", "", {4, 32}},
        Field{"steps", &R::steps, "of training of a level", "", {0, 1e6}},
        Field{"batch", &R::batch, "pictures a step", "", {1, 64}},
        Field{"crop", &R::crop, "side of the pictures of a step, at most", "pixels", {16, 4096}},
        Field{"learning_rate", &R::learning_rate, "of Adam, at first", "", {1e-6, 1}},
        Field{"coarser_rate",
              &R::coarser_rate,
              "share of it with which the next coarser level is trained on",
              "",
              {0, 1}},
        Field{"patch_size", &R::patch_size, "sides of patches, odd, by turns", "pixels", {1, 15}},
        Field{
            "directions", &R::directions, "that patches are projected on in a step", "", {1, 1024}},
        Field{
            "whitening", &R::whitening, "of colours: 0 as they are, 1 all axes alike", "", {0, 1}},
        Field{"adversary", &R::adversary, "weight of the discriminator's loss", "", {0, 100}},
        Field{"adversary_hidden",
              &R::adversary_hidden,
              "channels of the discriminator",
              "",
              {4, 128}},
        Field{"adversary_layers", &R::adversary_layers, "its convolutions of 3x3", "", {1, 8}},
        Field{"reconstruction",
              &R::reconstruction,
              "weight of the difference from the exemplar's own finer level",
              "",
              {0, 100}},
        Field{"sample_every", &R::sample_every, "steps between sample pictures", "", {1, 1e6}},
        Field{"seed", &R::seed, "of the training's random numbers", "", {0, 2147483647}},
    };
  }
};

/// A list's number for a level.
template <class T>
T at_level(const std::vector<T>& list, int level) {
  const auto last = list.size() - 1;
  return list[static_cast<std::size_t>(level) < last ? static_cast<std::size_t>(level) : last];
}

}  // namespace gramloom
