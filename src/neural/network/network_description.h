#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/fields.h"
#include "core/image.h"

namespace gramloom {

// What a file of models/ says: the layers of a network from the picture on, each by name. Layers
// of one input and one output follow each other; weights are another matter.

/// Cross-correlation with `channels` filters of kernel × kernel, spread by `dilation`.
struct ConvolutionLayer {
  static constexpr std::string_view name = "convolution";
  static constexpr std::string_view summary = "filters over all channels of the layer before";
  int channels = 64;
  int kernel = 3;
  int dilation = 1;

  static constexpr auto fields() {
    using L = ConvolutionLayer;
    return std::tuple{
        Field{"channels", &L::channels, "number of filters", "", {1, 8192}},
        Field{"kernel", &L::kernel, "side of a filter, odd", "positions", {1, 101}},
        Field{"dilation", &L::dilation, "distance of a filter's taps", "positions", {1, 256}}};
  }
};

/// Several convolutions side by side, each over its own blurred copy of the input: filters of many
/// scales at full resolution (Ustyuzhaninov, Brendel, Gatys, Bethge 2017 use big kernels; blurring
/// and dilating small ones costs a fraction). Branch i has kernels[i], dilations[i], blurs[i].
struct BankLayer {
  static constexpr std::string_view name = "bank";
  static constexpr std::string_view summary = "filters of several scales side by side";
  int channels = 64;
  std::vector<int> kernels{3};
  std::vector<int> dilations;
  std::vector<double> blurs;

  static constexpr auto fields() {
    using L = BankLayer;
    return std::tuple{
        Field{"channels", &L::channels, "number of filters of each branch", "", {1, 8192}},
        Field{"kernels", &L::kernels, "side of the branch's filters, odd", "positions", {1, 101}},
        Field{"dilations",
              &L::dilations,
              "distance of the filters' taps; empty: 1 each",
              "positions",
              {1, 256}},
        Field{"blurs",
              &L::blurs,
              "standard deviation of the blur before it; empty: 0 each",
              "positions",
              {0, 64}}};
  }
};

/// The picture at several sizes, each half as large as the one before (any size, even odd ones),
/// and each with filters of its own: the scales of a bank at a fraction of its cost, since what is
/// coarse needs few positions. Must be the first layer; those after it act on each scale alone.
/// Statistics are taken across the scales.
struct PyramidLayer {
  static constexpr std::string_view name = "pyramid";
  static constexpr std::string_view summary = "filters on the picture at several sizes";
  int channels = 64;
  int kernel = 5;
  int scales = 5;

  static constexpr auto fields() {
    using L = PyramidLayer;
    return std::tuple{
        Field{"channels", &L::channels, "number of filters of each scale", "", {1, 8192}},
        Field{"kernel", &L::kernel, "side of a filter, odd", "positions", {1, 101}},
        Field{"scales", &L::scales, "sizes of the picture: whole, half, …", "", {1, 12}}};
  }
};

/// max(x, 0).
struct ReluLayer {
  static constexpr std::string_view name = "relu";
  static constexpr std::string_view summary = "max(x, 0)";
  static constexpr auto fields() { return std::tuple{}; }
};

/// 2×2 with stride 2; an odd last row or column is left out.
struct AveragePoolLayer {
  static constexpr std::string_view name = "average_pool";
  static constexpr std::string_view summary = "mean of 2×2 positions, stride 2";
  static constexpr auto fields() { return std::tuple{}; }
};
struct MaxPoolLayer {
  static constexpr std::string_view name = "max_pool";
  static constexpr std::string_view summary = "largest of 2×2 positions, stride 2";
  static constexpr auto fields() { return std::tuple{}; }
};

using LayerKind = std::variant<ConvolutionLayer, BankLayer, PyramidLayer, ReluLayer,
                               AveragePoolLayer, MaxPoolLayer>;

struct NetworkLayer {
  std::string name;
  LayerKind kind;
};

struct NetworkDescription {
  std::string name;
  std::string summary;
  /// Layers whose statistics a synthesis matches when its config names none.
  std::vector<std::string> matched;
  /// What trained weights expect: (value − input_mean) / input_deviation for each channel of a
  /// picture in [0, 1]. Empty for networks that are only ever random.
  std::vector<double> input_mean;
  std::vector<double> input_deviation;
  std::vector<NetworkLayer> layers;

  static constexpr auto fields() {
    using N = NetworkDescription;
    return std::tuple{
        Field{"name", &N::name, "the network's name"},
        Field{"summary", &N::summary, "what it is, in a line"},
        Field{"matched", &N::matched, "layers whose statistics are matched by default"},
        Field{"input_mean", &N::input_mean, "mean of each input channel for trained weights"},
        Field{"input_deviation",
              &N::input_deviation,
              "deviation of each input channel for trained weights",
              "",
              {1e-6}},
    };
  }
};

/// The file for `network`: itself when it is a path, or NAME.toml of the models folder when it is a
/// bare word. Throws ConfigError when there is none (and names those that there are).
std::filesystem::path find_network(const FileOrName& network);
/// The network descriptions of the models folder, by name.
std::vector<std::filesystem::path> known_networks();

/// Throws ConfigError, with line and column, for whatever is not a network.
NetworkDescription read_network(const std::filesystem::path& file);

/// Index of the layer of that name. Throws ConfigError naming the closest.
std::size_t find_layer(const NetworkDescription& network, const std::string& layer);

/// The sizes of the layers' maps of a picture; `valid`: axes on which convolutions see nothing
/// beyond the edges. A pyramid's scales are pictures of their own. Throws Error when one would be
/// empty.
std::vector<Size> map_sizes(const NetworkDescription& network, Size picture, Tile valid);

/// One filter bank of a network: a convolution layer, one branch of a bank, one scale of a pyramid.
struct FilterShape {
  std::size_t layer = 0;  // index in NetworkDescription::layers
  int outputs = 0, inputs = 0, kernel = 0, dilation = 1;
  double blur = 0;

  std::int64_t parameters() const {  // weights and biases
    return static_cast<std::int64_t>(outputs) * (std::int64_t{inputs} * kernel * kernel + 1);
  }
};
/// All of them in order, for pictures of `channels` channels.
std::vector<FilterShape> filter_shapes(const NetworkDescription& network, int channels);

}  // namespace gramloom
