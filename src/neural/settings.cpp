#include "neural/settings.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>

#include "io/field_values.h"
#include "io/image_file.h"

namespace gramloom::neural {

namespace {
constexpr int least_octave_side = 48;  // of the exemplar, of a layout

// Whether what levels from noise depend on, and octaves do not, was left as it is.
bool has_usual_levels(const NeuralParams& params) {
  const NeuralParams usual;
  return params.coarsest_side == usual.coarsest_side && params.level_factor == usual.level_factor;
}

}  // namespace

Layout layout_by_size(const NeuralParams& params, Size exemplar, const Target& target) {
  if (params.layout != Layout::automatic) return params.layout;
  const auto shorter = [](Size size) { return std::min(size.width, size.height); };
  const bool flow = params.levels == 0 && has_usual_levels(params) && params.sliced_weight > 0 &&
                    params.start.empty() && shorter(exemplar) >= 2 * least_octave_side &&
                    shorter(target.size) >= least_octave_side;
  return flow ? Layout::flow : Layout::noise;
}

int level_count(const NeuralParams& params, Size exemplar, const Target& target) {
  if (params.levels > 0) return params.levels;
  const int patch = params.sliced_weight > 0
                        ? *std::max_element(params.patch_sizes.begin(), params.patch_sizes.end())
                        : 1;
  const bool flow = layout_by_size(params, exemplar, target) == Layout::flow;
  const auto fits = [&](int level) {
    const Size own = level_size(params, exemplar, level);
    const Size result = level_size(params, target.size, level);
    if (flow)
      return std::min(own.width, own.height) >= least_octave_side &&
             std::min(result.width, result.height) >= least_octave_side / 2;
    return std::min(own.width, own.height) >= std::max(params.coarsest_side, patch) &&
           (tiles_x(target.tile) || result.width >= patch) &&
           (tiles_y(target.tile) || result.height >= patch);
  };
  int levels = 1;
  while (fits(levels)) ++levels;
  return levels;
}

Size level_size(const NeuralParams& params, Size whole, int level) {
  const double factor = std::pow(params.layout == Layout::flow ? 0.5 : params.level_factor, level);
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(side * factor)));
  };
  return {scaled(whole.width), scaled(whole.height)};
}

Size canvas_size(const NeuralParams& params, const Target& target) {
  Size size = target.size;
  if (params.sliced_weight == 0 || !params.start.empty() || !target.known.empty()) return size;
  const int patch = *std::max_element(params.patch_sizes.begin(), params.patch_sizes.end());
  // What lies at an edge is in few patches and may be of any brightness, on coarse levels in a
  // wider strip: of a large picture a strip as wide is little work more.
  constexpr int part = 40, widest = 8;
  const int margin = std::clamp(std::min(size.width, size.height) / part, patch, widest * patch);
  if (!tiles_x(target.tile)) size.width += 2 * margin;
  if (!tiles_y(target.tile)) size.height += 2 * margin;
  return size;
}

bool fills_window(const NeuralParams& params, const RequestSize& request) {
  constexpr double most_of_window = 0.7;  // of the picture
  return request.known && params.start.empty() && params.levels == 0 && area(request.around) > 0 &&
         area(request.around) <= most_of_window * area(request.size);
}

bool is_shared(const NeuralParams& params, Size level, int processes) {
  constexpr int least_rows = 64;  // of a process: more than others look at
  const int patch = *std::max_element(params.patch_sizes.begin(), params.patch_sizes.end());
  return processes > 1 && level.height / processes >= std::max(least_rows, 2 * patch) &&
         std::int64_t{level.width - patch + 1} * (level.height - patch + 1) > params.positions;
}

std::int64_t steps_down_to(const NeuralParams& params, int levels, int level) {
  std::int64_t steps = 0;
  for (int l = level; l < levels; ++l) {
    steps += at_level(params.iterations, l);
    if (params.layout == Layout::flow) steps += at_level(params.flow_steps, l);
  }
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
  not_empty("flow_patch_sizes", params.flow_patch_sizes);
  not_empty("flow_steps", params.flow_steps);
  not_empty("flow_renoise", params.flow_renoise);
  not_empty("flow_neighbours", params.flow_neighbours);
  if (params.layout == Layout::flow && !has_usual_levels(params))
    throw ConfigError(
        "coarsest_side and level_factor have no effect with layout = \"flow\", whose levels are "
        "octaves: leave them out, or say how many with levels");
  if (params.layout == Layout::noise) {
    const NeuralParams preset = with_preset(params.preset);
    for_each_field<FlowParams>([&](const auto& field) {
      if (params.*field.member != preset.*field.member)
        throw ConfigError("{} has no effect without a layout by flow (layout = \"flow\")",
                          field.name);
    });
  }
  if (params.layout == Layout::flow && !params.start.empty())
    throw ConfigError(
        "layout = \"flow\" has no effect with a picture to start from: leave out layout or start");
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

namespace {

// The picture at each of the sizes that a network looks at.
std::vector<Size> scales_of(const NetworkDescription& network, Size size) {
  std::vector<Size> scales{size};
  if (const auto* pyramid = std::get_if<PyramidLayer>(&network.layers.front().kind))
    while (scales.size() < static_cast<std::size_t>(pyramid->scales))
      scales.push_back({(scales.back().width + 1) / 2, (scales.back().height + 1) / 2});
  return scales;
}

}  // namespace

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

void check_levels(const NeuralParams& params, const NetworkDescription* network, Size exemplar,
                  const Target& target) {
  const int levels = level_count(params, exemplar, target);
  const Size own = level_size(params, exemplar, levels - 1);
  const Size result = level_size(params, canvas_size(params, target), levels - 1);
  try {
    if (params.layout == Layout::flow) {
      for (int level = 0; level < levels; ++level) {
        const int side = at_level(params.flow_patch_sizes, level);
        const Size at = level_size(params, exemplar, level);
        if (std::min(at.width, at.height) >= side) continue;
        throw Error(
            "the exemplar of {0}×{1} is too small for a layout of patches of {2}×{2}: make "
            "flow_patch_sizes smaller, or layout = \"noise\"",
            at.width, at.height, side);
      }
    }
    if (params.sliced_weight > 0) check_patches_fit(params.patch_sizes, own, result, target.tile);
    if (!network) return;
    const auto check_network = [&](Size size, bool valid_x, bool valid_y) {
      for (const Size scale : scales_of(*network, size))
        map_sizes(*network, scale, wrapping(valid_x, valid_y));
    };
    const bool valid = params.padding == Padding::valid;
    const bool exemplar_valid = params.exemplar_padding == Padding::valid;
    check_network(own, exemplar_valid, exemplar_valid);
    check_network(result, valid && !tiles_x(target.tile), valid && !tiles_y(target.tile));
  } catch (const Error& error) {
    if (levels == 1) throw;
    throw Error("on the coarsest of {} levels, {}; or take fewer levels", levels, error.what());
  }
}

Image read_start(const NeuralParams& params, int channels) {
  Image image = read_image(params.start).image;
  if (image.channels != channels)
    throw Error("{}: has {} channels, the exemplar has {}", params.start.string(), image.channels,
                channels);
  return image;
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

std::string weight_name(std::size_t layer) { return fmt::format("features.{}.weight", layer); }
std::string bias_name(std::size_t layer) { return fmt::format("features.{}.bias", layer); }

namespace {

void check_tensor(const std::filesystem::path& file,
                  const std::map<std::string, TensorData>& tensors, const std::string& name,
                  const std::vector<std::int64_t>& shape) {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw Error("{}: no tensor '{}'", file.string(), name);
  if (found->second.shape != shape)
    throw Error("{}: tensor '{}' has shape [{}], the network needs [{}]", file.string(), name,
                fmt::join(found->second.shape, ", "), fmt::join(shape, ", "));
  for (const float value : found->second.values)
    if (!std::isfinite(value))
      throw Error("{}: tensor '{}' holds a value that is no finite number", file.string(), name);
}

}  // namespace

std::map<std::string, TensorData> read_weights(const NetworkDescription& description,
                                               const std::vector<FilterShape>& shapes,
                                               const std::filesystem::path& file) {
  std::set<std::string> names;
  for (const auto& shape : shapes) {
    const auto& layer = description.layers[shape.layer];
    if (!std::holds_alternative<ConvolutionLayer>(layer.kind))
      throw Error(
          "{}: layer '{}' of network '{}' has filters of several scales, which only random "
          "weights can fill",
          file.string(), layer.name, description.name);
    names.insert(weight_name(shape.layer));
    names.insert(bias_name(shape.layer));
  }
  auto tensors = read_tensors(file, [&](const std::string& name) { return names.contains(name); });
  for (const auto& shape : shapes) {
    check_tensor(file, tensors, weight_name(shape.layer),
                 {shape.outputs, shape.inputs, shape.kernel, shape.kernel});
    check_tensor(file, tensors, bias_name(shape.layer), {shape.outputs});
  }
  return tensors;
}

}  // namespace gramloom::neural
