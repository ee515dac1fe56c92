#include "neural/settings.h"

#include <algorithm>
#include <bit>

#include "core/hash.h"
#include "io/field_values.h"
#include "io/text_file.h"

namespace gramloom::neural {

std::vector<Loss::MatchedLayer> matched_layers(const NeuralParams& params,
                                               NetworkDescription& description) {
  const auto& names = params.layers.empty() ? description.matched : params.layers;
  if (!params.layer_weights.empty() && params.layer_weights.size() != names.size())
    throw ConfigError("layer_weights has {} values for {} layers ({})", params.layer_weights.size(),
                      names.size(), fmt::join(names, ", "));
  std::vector<Loss::MatchedLayer> layers;
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

Network make_network(const NeuralParams& params, const NetworkDescription& description,
                     const at::Tensor& exemplar) {
  const int channels = static_cast<int>(exemplar.size(0));
  const auto shapes = filter_shapes(description, channels);
  if (params.weights.empty()) {
    auto filters = random_filters(shapes, params.random_weights,
                                  static_cast<std::uint64_t>(params.weights_seed));
    if (!params.rescale) return {description, shapes, std::move(filters), params.pooling};
    return Network::rescaled(description, shapes, std::move(filters), params.pooling, exemplar,
                             {params.exemplar_padding, params.exemplar_padding});
  }
  return {description, shapes, load_filters(description, shapes, params.weights), params.pooling};
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
  hash.add(read_text(find_network(params.network)));
  hash.add(exemplar.pixels.data(), exemplar.pixels.size() * sizeof(float));
  return hash.text();
}

}  // namespace gramloom::neural
