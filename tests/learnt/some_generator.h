#pragma once

#include <cmath>

#include "core/random.h"
#include "learnt/generator_model.h"

namespace gramloom {

/// A generator that has learnt nothing: its tensors are random, of a size that keeps values near 1.
/// Its channels are a picture of three and, of more, scalar maps.
inline GeneratorModel some_generator(std::vector<GeneratorLevel> levels, int channels = 3,
                                     int materials = 1, std::uint64_t seed = 1) {
  GeneratorModel model;
  GeneratorDescription& description = model.description;
  description.channels = channels;
  description.levels = std::move(levels);
  for (int m = 0; m < materials; ++m)
    description.materials.push_back({fmt::format("material {}", m), "", ""});
  const int colours = channels < 3 ? 1 : 3;
  description.layers.push_back(
      {"", colours == 1 ? MapKind::scalar : MapKind::colour, 0, colours, GreenAxis::up});
  for (int c = colours; c < channels; ++c)
    description.layers.push_back({fmt::format("map{}", c), MapKind::scalar, c, 1, GreenAxis::up});
  Random random(seed);
  for (const auto& [name, shape] : tensor_shapes(description)) {
    std::int64_t count = 1;
    for (const std::int64_t side : shape) count *= side;
    const auto inputs = shape.size() == 4 ? static_cast<float>(count / shape[0]) : 25.0f;
    TensorData& tensor = model.tensors[name] = {shape, {}};
    for (std::int64_t i = 0; i < count; ++i)
      tensor.values.push_back(random.normal() / std::sqrt(inputs));
  }
  for (int c = 0; c < channels; ++c) {
    const auto i = static_cast<std::size_t>(c);
    model.tensors["colours.mean"].values[i] += 0.5f;
    model.tensors["colours.low"].values[i] = 0.05f;
    model.tensors["colours.high"].values[i] = 0.9f;
  }
  return model;
}

}  // namespace gramloom
