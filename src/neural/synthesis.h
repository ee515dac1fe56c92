#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"

namespace gramloom {

/// What a convolution sees beyond the edges of the picture.
enum class Padding { circular, reflect, zero, valid };
enum class Pooling { as_described, average, max };
enum class RandomWeights { he_normal, orthogonal };
enum class Optimizer { lbfgs, adam };

template <>
inline constexpr auto enum_names<Padding> = std::to_array<std::string_view>({"circular", "reflect",
                                                                             "zero", "valid"});
template <>
inline constexpr auto enum_names<Pooling> = std::to_array<std::string_view>({"as_described",
                                                                             "average", "max"});
template <>
inline constexpr auto enum_names<RandomWeights> = std::to_array<std::string_view>({"he_normal",
                                                                                   "orthogonal"});
template <>
inline constexpr auto enum_names<Optimizer> = std::to_array<std::string_view>({"lbfgs", "adam"});

/// Texture synthesis by Gram matrices of a convolutional network's feature maps (Gatys, Ecker,
/// Bethge 2015, "Texture synthesis using convolutional neural networks"): a noise image is changed
/// step by step until its Gram matrices are those of the exemplar,
///   G_l = F_l F_lᵀ,  E_l = 1/(4 N_l² M_l²) Σ (G_l − Ĝ_l)²,  L = Σ w_l E_l,
/// with F_l the N_l feature maps of layer l at M_l positions. Departures from the paper, each an
/// option: G is divided by M, so that exemplar and result may differ in size (equal to the paper
/// when they don't); see normalise, centre, standardise, whiten_colour.
struct NeuralParams {
  static constexpr std::string_view kind = "neural";
  static constexpr std::string_view summary =
      "Gram matrices of a convolutional network (Gatys, Ecker, Bethge 2015)";

  std::filesystem::path network = "multiscale";
  std::filesystem::path weights;
  RandomWeights random_weights = RandomWeights::he_normal;
  int weights_seed = 1;
  bool rescale = true;
  Padding padding = Padding::circular;
  Padding exemplar_padding = Padding::reflect;
  Pooling pooling = Pooling::as_described;

  std::vector<std::string> layers;
  std::vector<double> layer_weights;
  bool normalise = true;
  bool centre = true;
  bool standardise = true;
  bool whiten_colour = true;

  Optimizer optimizer = Optimizer::lbfgs;
  int iterations = 200;
  double learning_rate = 0.03;
  int history = 20;
  double stop_loss = 0;
  double stop_seconds = std::numeric_limits<double>::infinity();

  int levels = 1;
  double level_factor = 0.5;
  std::filesystem::path start;
  double noise = 1;
  bool match_histogram = false;

  static constexpr auto fields() {
    using P = NeuralParams;
    return std::tuple{
        Field{"network", &P::network, "network description: a name in models/, or a .toml file"},
        Field{"weights", &P::weights, "trained weights, a .safetensors file; empty: random"},
        Field{"random_weights", &P::random_weights, "distribution of random weights"},
        Field{"weights_seed", &P::weights_seed, "seed of random weights", "", {0, 2147483647}},
        Field{"rescale", &P::rescale,
              "scale each filter so that its mean activation on the exemplar is 1"},
        Field{"padding", &P::padding, "what a convolution sees beyond an edge that does not tile"},
        Field{"exemplar_padding", &P::exemplar_padding,
              "what a convolution sees beyond the edges of the exemplar"},
        Field{"pooling", &P::pooling, "how pooling layers pool"},
        Field{"layers", &P::layers,
              "layers whose statistics are matched; empty: the network's own"},
        Field{"layer_weights", &P::layer_weights, "weight w of each layer; empty: 1 each", "", {0}},
        Field{"normalise", &P::normalise,
              "divide each layer's error by its value for the exemplar against nothing"},
        Field{"centre", &P::centre,
              "subtract each feature map's mean on the exemplar, and match means as a statistic"},
        Field{"standardise", &P::standardise,
              "divide each feature map by its standard deviation on the exemplar"},
        Field{"whiten_colour", &P::whiten_colour,
              "decorrelate the channels by the exemplar's principal components"},
        Field{"optimizer", &P::optimizer, "how the image is changed"},
        Field{"iterations", &P::iterations, "steps of the optimiser on each level", "", {0, 1e6}},
        Field{"learning_rate",
              &P::learning_rate,
              "step of Adam, in units of the whitened image",
              "",
              {1e-6, 10}},
        Field{"history", &P::history, "steps that L-BFGS remembers", "steps", {1, 1000}},
        Field{"stop_loss",
              &P::stop_loss,
              "stop when the loss is below this part of the first one",
              "",
              {0, 1}},
        Field{"stop_seconds",
              &P::stop_seconds,
              "stop after this time",
              "seconds",
              {0, std::numeric_limits<double>::infinity()}},
        Field{"levels",
              &P::levels,
              "levels of the image pyramid, coarse to fine; 1: no pyramid",
              "",
              {1, 12}},
        Field{"level_factor",
              &P::level_factor,
              "size of a level relative to the next finer one",
              "",
              {0.25, 0.95}},
        Field{"start", &P::start, "image to start from; empty: noise"},
        Field{"noise",
              &P::noise,
              "standard deviation of the noise to start from, relative to the exemplar's colours",
              "",
              {1e-4, 10}},
        Field{"match_histogram", &P::match_histogram,
              "at the end, give each channel the exemplar's histogram"},
    };
  }
};

/// The texture. When `control` asks to stop, what there is so far.
/// Throws ConfigError for a network, layer or weights that cannot be, Error for an exemplar too
/// small for the network.
Texture synthesise(const NeuralParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const NeuralParams& params, Size exemplar, int channels, const Target& target);

}  // namespace gramloom
