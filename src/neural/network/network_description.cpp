#include "neural/network/network_description.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "io/models_folder.h"
#include "io/text_file.h"
#include "io/toml_reader.h"
#include "neural/params.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

LayerKind read_kind(const toml::table& table) {
  LayerKind kind;
  with_alternative<LayerKind>(read_alternative<LayerKind>(table, "type"),
                              [&]<class T>(std::type_identity<T>) {
                                check_keys(table, key_names<T>({"name", "type"}));
                                T layer;
                                read_fields(layer, table);
                                kind = layer;
                              });
  return kind;
}

void check_odd(int kernel, const toml::table& table, std::string_view key) {
  if (kernel % 2 == 0)
    fail(key_region(table, key), "'{}' = {}: a filter's side must be odd", key, kernel);
}

void check_branches(BankLayer& bank, const toml::table& table) {
  const std::size_t branches = bank.kernels.size();
  if (branches == 0) fail(key_region(table, "kernels"), "'kernels' is empty");
  for (const int kernel : bank.kernels) check_odd(kernel, table, "kernels");
  if (bank.dilations.empty()) bank.dilations.assign(branches, 1);
  if (bank.blurs.empty()) bank.blurs.assign(branches, 0);
  const auto check = [&](std::size_t count, std::string_view key) {
    if (count != branches)
      fail(key_region(table, key), "'{}' has {} values, 'kernels' has {}", key, count, branches);
  };
  check(bank.dilations.size(), "dilations");
  check(bank.blurs.size(), "blurs");
}

NetworkLayer read_layer(const toml::table& table) {
  NetworkLayer layer{required_text(table, "name"), read_kind(table)};
  if (const auto* convolution = std::get_if<ConvolutionLayer>(&layer.kind))
    check_odd(convolution->kernel, table, "kernel");
  if (const auto* pyramid = std::get_if<PyramidLayer>(&layer.kind))
    check_odd(pyramid->kernel, table, "kernel");
  if (auto* bank = std::get_if<BankLayer>(&layer.kind)) check_branches(*bank, table);
  return layer;
}

void read_layers(NetworkDescription& network, const toml::table& table) {
  const toml::node* node = table.get("layer");
  if (!node || !node->is_array_of_tables())
    fail(key_region(table, "layer"), "a network needs [[layer]] tables");
  std::set<std::string> names;
  for (const auto& element : *node->as_array()) {
    const toml::table& layer = *element.as_table();
    network.layers.push_back(read_layer(layer));
    if (network.layers.size() > 1 &&
        std::holds_alternative<PyramidLayer>(network.layers.back().kind))
      fail(key_region(layer, "type"), "a pyramid must be the first layer");
    if (!names.insert(network.layers.back().name).second)
      fail(key_region(layer, "name"), "two layers are named '{}'", network.layers.back().name);
  }
}

std::vector<std::string> layer_names(const NetworkDescription& network) {
  std::vector<std::string> names;
  for (const auto& layer : network.layers) names.push_back(layer.name);
  return names;
}

}  // namespace

std::vector<fs::path> known_networks() { return models_in_folder(".toml"); }

fs::path find_network(const FileOrName& network) { return find_model(network, ".toml", "network"); }

fs::path network_file(const NeuralParams& params) {
  return needs_network(params) ? find_network(params.network) : fs::path();
}

NetworkDescription read_network(const fs::path& file) {
  std::string text;
  try {
    text = read_text(file);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
  const toml::table table = parse_toml(text, file.string());
  check_keys(table, key_names<NetworkDescription>({"layer"}));
  NetworkDescription network;
  network.name = required_text(table, "name");
  read_fields(network, table);
  read_layers(network, table);
  for (const auto& name : network.matched) {
    const auto names = layer_names(network);
    index_of_word(name, names, "layer", key_region(table, "matched"));
  }
  if (network.matched.empty()) fail(key_region(table, "matched"), "'matched' names no layer");
  if (network.input_mean.size() != network.input_deviation.size())
    fail(key_region(table, "input_deviation"),
         "'input_mean' has {} values, 'input_deviation' has {}", network.input_mean.size(),
         network.input_deviation.size());
  return network;
}

std::size_t find_layer(const NetworkDescription& network, const std::string& layer) {
  const auto names = layer_names(network);
  const auto found = std::find(names.begin(), names.end(), layer);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string guess = closest_word(layer, names);
  throw ConfigError("network '{}' has no layer '{}' ({})", network.name, layer,
                    guess.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean '{}'?", guess));
}

namespace {

// Positions that a layer's filters see to each side.
int radius_of(const LayerKind& kind) {
  if (const auto* convolution = std::get_if<ConvolutionLayer>(&kind))
    return convolution->kernel / 2 * convolution->dilation;
  if (const auto* pyramid = std::get_if<PyramidLayer>(&kind)) return pyramid->kernel / 2;
  int radius = 0;
  if (const auto* bank = std::get_if<BankLayer>(&kind))
    for (std::size_t i = 0; i < bank->kernels.size(); ++i)
      radius = std::max(radius, bank->kernels[i] / 2 * bank->dilations[i]);
  return radius;
}

}  // namespace

std::vector<Size> map_sizes(const NetworkDescription& network, Size picture, Tile valid) {
  std::vector<Size> sizes;
  Size size = picture;
  for (const NetworkLayer& layer : network.layers) {
    const int lost = 2 * radius_of(layer.kind);
    if (tiles_x(valid)) size.width -= lost;
    if (tiles_y(valid)) size.height -= lost;
    if (std::holds_alternative<AveragePoolLayer>(layer.kind) ||
        std::holds_alternative<MaxPoolLayer>(layer.kind))
      size = {size.width / 2, size.height / 2};
    if (size.width < 1 || size.height < 1)
      throw Error(
          "layer '{}' of network '{}' would be empty: a picture of {}×{} is too small for it",
          layer.name, network.name, picture.width, picture.height);
    sizes.push_back(size);
  }
  return sizes;
}

std::vector<FilterShape> filter_shapes(const NetworkDescription& network, int channels) {
  std::vector<FilterShape> shapes;
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    if (const auto* l = std::get_if<ConvolutionLayer>(&network.layers[i].kind)) {
      shapes.push_back({i, l->channels, channels, l->kernel, l->dilation, 0});
      channels = l->channels;
    } else if (const auto* bank = std::get_if<BankLayer>(&network.layers[i].kind)) {
      const std::size_t branches = bank->kernels.size();
      for (std::size_t b = 0; b < branches; ++b)
        shapes.push_back(
            {i, bank->channels, channels, bank->kernels[b], bank->dilations[b], bank->blurs[b]});
      channels = bank->channels * static_cast<int>(branches);
    } else if (const auto* pyramid = std::get_if<PyramidLayer>(&network.layers[i].kind)) {
      for (int scale = 0; scale < pyramid->scales; ++scale)
        shapes.push_back({i, pyramid->channels, channels, pyramid->kernel, 1, 0});
      channels = pyramid->channels;
    }
  }
  return shapes;
}

}  // namespace gramloom
