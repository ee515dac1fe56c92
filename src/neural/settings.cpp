#include "neural/settings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/hash.h"
#include "io/field_values.h"
#include "io/text_file.h"

namespace gramloom::neural {

int level_count(const NeuralParams& params, Size exemplar, const Target& target) {
  if (params.levels > 0) return params.levels;
  const int patch = params.sliced_weight > 0
                        ? *std::max_element(params.patch_sizes.begin(), params.patch_sizes.end())
                        : 1;
  const auto fits = [&](int level) {
    const Size own = level_size(params, exemplar, level);
    const Size result = level_size(params, target.size, level);
    return std::min(own.width, own.height) >= std::max(params.coarsest_side, patch) &&
           (tiles_x(target.tile) || result.width >= patch) &&
           (tiles_y(target.tile) || result.height >= patch);
  };
  int levels = 1;
  while (fits(levels)) ++levels;
  return levels;
}

Size level_size(const NeuralParams& params, Size whole, int level) {
  const double factor = std::pow(params.level_factor, level);
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(side * factor)));
  };
  return {scaled(whole.width), scaled(whole.height)};
}

Size canvas_size(const NeuralParams& params, const Target& target) {
  Size size = target.size;
  if (params.sliced_weight == 0 || !params.start.empty()) return size;
  const int margin = *std::max_element(params.patch_sizes.begin(), params.patch_sizes.end());
  if (!tiles_x(target.tile)) size.width += 2 * margin;
  if (!tiles_y(target.tile)) size.height += 2 * margin;
  return size;
}

std::int64_t steps_down_to(const NeuralParams& params, int levels, int level) {
  std::int64_t steps = 0;
  for (int l = level; l < levels; ++l) steps += at_level(params.iterations, l);
  return steps;
}

void check_settings(const NeuralParams& params) {
  check_fields(params);
  const auto not_empty = [](const char* key, const auto& list) {
    if (list.empty()) throw ConfigError("{} is an empty list", key);
  };
  not_empty("iterations", params.iterations);
  not_empty("optimizer", params.optimizer);
  not_empty("patch_sizes", params.patch_sizes);
  const double layer_weights =
      params.layer_weights.empty()
          ? 1
          : std::accumulate(params.layer_weights.begin(), params.layer_weights.end(), 0.0);
  double weights = 0;
  for_each_term(params, [&]<class Term>(const Term& term) {
    weights += term.weight() * (LooksAtNetwork<Term> ? layer_weights : 1);
  });
  if (weights == 0)
    throw ConfigError(
        "there is nothing to match: sliced_weight, gram_weight and the other weights are all 0");
  const auto of_network = [&](const char* key, bool given) {
    if (given && !needs_network(params))
      throw ConfigError(
          "{} has no effect while gram_weight and sliced_features_weight are 0: set one, or "
          "preset = \"gatys\"",
          key);
  };
  of_network("weights", !params.weights.empty());
  of_network("layers", !params.layers.empty());
  of_network("layer_weights", !params.layer_weights.empty());
}

std::vector<MatchedLayer> matched_layers(const NeuralParams& params,
                                         NetworkDescription& description) {
  const auto& names = params.layers.empty() ? description.matched : params.layers;
  if (!params.layer_weights.empty() && params.layer_weights.size() != names.size())
    throw ConfigError("layer_weights has {} values for {} layers ({})", params.layer_weights.size(),
                      names.size(), fmt::join(names, ", "));
  const auto of_pyramid = [&](const char* key, Padding padding) {
    if (padding == Padding::valid &&
        std::holds_alternative<PyramidLayer>(description.layers[0].kind))
      throw ConfigError(
          "{} = \"valid\" does not go with network '{}': the sizes of its pyramid would lose "
          "different margins (allowed are circular, reflect, zero)",
          key, description.name);
  };
  of_pyramid("padding", params.padding);
  of_pyramid("exemplar_padding", params.exemplar_padding);
  std::vector<MatchedLayer> layers;
  for (std::size_t i = 0; i < names.size(); ++i)
    layers.push_back({find_layer(description, names[i]),
                      params.layer_weights.empty() ? 1 : params.layer_weights[i]});
  std::sort(layers.begin(), layers.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  for (std::size_t i = 1; i < layers.size(); ++i)
    if (layers[i].index == layers[i - 1].index)
      throw ConfigError("layer '{}' is named twice", description.layers[layers[i].index].name);
  description.layers.resize(layers.back().index + 1);
  return layers;
}

void check_weights(const NeuralParams& params, const NetworkDescription& description,
                   int channels) {
  if (params.weights.empty()) return;
  if (!description.input_mean.empty() &&
      description.input_mean.size() != static_cast<std::size_t>(channels))
    throw Error("{}: trained weights of '{}' look at {} channels, the exemplar has {}",
                params.weights.string(), description.name, description.input_mean.size(), channels);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(params.weights, ignored))
    throw ConfigError("weights: there is no file {}", params.weights.string());
}

std::string fingerprint(const NeuralParams& params, const Image& exemplar, const Target& target,
                        Random random) {
  Fnv1a hash;
  for_each_field<NeuralParams>([&](const auto& field) {
    hash.add(fmt::format("{}={};", field.name, value_to_text(params.*field.member)));
  });
  hash.add(fmt::format("{}×{} {} seed {} exemplar {}×{}×{};", target.size.width, target.size.height,
                       to_word(target.tile), random.seed(), exemplar.width, exemplar.height,
                       exemplar.channels));
  if (needs_network(params)) hash.add(read_text(find_network(params.network)));
  hash.add(exemplar.pixels.data(), exemplar.pixels.size() * sizeof(float));
  return hash.text();
}

}  // namespace gramloom::neural
