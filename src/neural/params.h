#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/abilities.h"
#include "core/fields.h"
#include "neural/flow/params.h"
#include "neural/loss/terms.h"

namespace gramloom {

/// What a convolution sees beyond the edges of the picture.
enum class Padding { circular, reflect, zero, valid };
enum class Pooling { as_described, average, max };
enum class RandomWeights { he_normal, orthogonal };
enum class Optimizer { lbfgs, adam };
/// How a level begins: with the coarser one's picture, the coarsest with noise; or with patch flow
/// matching (flow/patch_flow.h), which makes larger and thinner things whole. `automatic` takes
/// flow where it is the better (settings.h).
enum class Layout { automatic, noise, flow };

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
template <>
inline constexpr auto enum_names<Layout> = std::to_array<std::string_view>({"automatic", "noise",
                                                                            "flow"});

/// Complete settings, each to be chosen by one word. `gatys` is the loss and the
/// optimiser of 2015, but for normalise, centre, standardise and whitening; with `network` vgg19
/// and trained `weights` it is the published method. The others are what we found best for random
/// filters, the faster the rougher (models/README.md).
enum class Preset { fast, balanced, quality, gatys };
template <>
inline constexpr auto enum_names<Preset> = std::to_array<std::string_view>({"fast", "balanced",
                                                                            "quality", "gatys"});

/// Texture synthesis by statistics of a network's feature maps or of random filters: a noise image
/// is changed step by step, coarse to fine, until its statistics are those of the exemplar. The
/// loss is the weighted sum of the terms in loss/terms.h, each explained in its header. In a trace
/// they have their names; those that look at a network have the layer's name too: gram_relu1_1.
///
/// A mask, several exemplars, known pixels, a guide and weights are honoured by patches alone: see
/// loss/directed_sliced.h for the distance, flow/patch_flow.h and flow/first_fill.h for layouts.
/// Where they are asked for, a preset's spectrum is left out, and what cannot be honoured, such as
/// terms that look at a network, is refused by name (directed_settings.h).
struct NeuralParams : LossParams, FlowParams {
  static constexpr std::string_view kind = "neural";
  static constexpr std::string_view summary =
      "statistics of random filters or of a network (Gatys et al. 2015; Heitz et al. 2021)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::guide,    Ability::mix,       Ability::fill};

  Preset preset = Preset::balanced;

  int directions = 32;

  FileOrName network = "multiscale";
  std::filesystem::path weights;
  RandomWeights random_weights = RandomWeights::he_normal;
  int weights_seed = 1;
  bool rescale = true;
  Padding padding = Padding::circular;
  Padding exemplar_padding = Padding::reflect;
  Pooling pooling = Pooling::as_described;
  std::vector<std::string> layers;
  std::vector<double> layer_weights;
  double whitening = 0.4;

  std::vector<Optimizer> optimizer{Optimizer::adam};
  std::vector<int> iterations{160, 240, 400};
  double learning_rate = 0.08;
  int history = 20;
  double stop_loss = 0;
  double stop_seconds = std::numeric_limits<double>::infinity();

  Layout layout = Layout::automatic;
  int levels = 0;
  int coarsest_side = 24;
  double level_factor = 0.7;
  double copy_limit = 0.15;
  std::filesystem::path start;
  double noise = 1;
  bool match_histogram = false;

  static constexpr auto fields() {
    using P = NeuralParams;
    constexpr std::tuple first{
        Field{"preset", &P::preset, "settings that all other keys start from"}};
    constexpr std::tuple others{
        Field{"directions",
              &P::directions,
              "random directions of each step along which patches or features are compared",
              "",
              {1, 4096}},
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
        Field{"whitening",
              &P::whitening,
              "how much the principal components of colour are made equally strong",
              "",
              {0, 1}},
        Field{"optimizer", &P::optimizer,
              "how the image is changed; of a list, the first is for the finest level, the last "
              "also for all coarser ones"},
        Field{"iterations",
              &P::iterations,
              "steps of the optimiser on each level; a list is read as that of optimizer",
              "",
              {0, 1e6}},
        Field{"learning_rate",
              &P::learning_rate,
              "first step of Adam on a level, relative to the exemplar's colours; it falls to a "
              "tenth",
              "",
              {1e-6, 10}},
        Field{"history", &P::history, "steps that L-BFGS remembers", "steps", {1, 1000}},
        Field{"stop_loss",
              &P::stop_loss,
              "stop a level when the loss is below this part of its first one",
              "",
              {0, 1}},
        Field{"stop_seconds",
              &P::stop_seconds,
              "stop after this time",
              "seconds",
              {0, std::numeric_limits<double>::infinity()}},
        Field{"layout", &P::layout, "how levels begin: from noise, or by patch flow matching"},
        Field{"levels",
              &P::levels,
              "levels of the image pyramid, coarse to fine; 0: by coarsest_side",
              "",
              {0, 64}},
        Field{"coarsest_side",
              &P::coarsest_side,
              "with levels = 0: the least shorter side of the exemplar on a level",
              "pixels",
              {4, 4096}},
        Field{"level_factor",
              &P::level_factor,
              "size of a level relative to the next finer one",
              "",
              {0.25, 0.95}},
        Field{
            "copy_limit",
            &P::copy_limit,
            "with levels = 0: a coarsest level of a result as large as the exemplar is thrown away "
            "when it correlates with it by so much more than a shifted exemplar does; 2: never",
            "",
            {0, 2}},
        Field{"start", &P::start, "image to start from; empty: noise"},
        Field{"noise",
              &P::noise,
              "standard deviation of the noise to start from, relative to the exemplar's colours",
              "",
              {1e-4, 10}},
        Field{"match_histogram", &P::match_histogram,
              "at the end, give each channel the exemplar's histogram"},
    };
    return std::tuple_cat(first, LossParams::fields(), others, FlowParams::fields());
  }
};

/// The settings of that preset.
NeuralParams with_preset(Preset preset);

/// Whether any term looks at a network's layers.
inline bool needs_network(const NeuralParams& params) {
  bool needed = false;
  for_each_term(params, [&]<class Term>(const Term&) { needed |= LooksAtNetwork<Term>; });
  return needed;
}

/// The file that describes the network, or "" when no term looks at one. Throws ConfigError when
/// there is none of that name.
std::filesystem::path network_file(const NeuralParams& params);

}  // namespace gramloom
