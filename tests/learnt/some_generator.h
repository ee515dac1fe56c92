#pragma once

#include <string>
#include <vector>

#include "core/random.h"
#include "learnt/generator_model.h"

namespace gramloom {

/// A generator with random weights, of three small levels, that has learnt nothing.
inline GeneratorModel some_generator(int materials = 1, int channels = 3) {
  GeneratorModel model;
  GeneratorDescription& description = model.description;
  description.channels = channels;
  description.layers = {{"", MapKind::colour, 0, 3, GreenAxis::up}};
  if (channels > 3)
    description.layers.push_back({"height", MapKind::scalar, 3, channels - 3, GreenAxis::up});
  description.levels = {{8, 16, 3}, {4, 24, 2}, {4, 8, 1}};
  for (int m = 0; m < materials; ++m)
    description.materials.push_back({std::string(1, static_cast<char>('a' + m)), "", ""});
  Random random(7);
  for (const auto& [name, shape] : tensor_shapes(description)) {
    TensorData& tensor = model.tensors[name];
    tensor.shape = shape;
    std::size_t count = 1;
    for (const std::int64_t side : shape) count *= static_cast<std::size_t>(side);
    for (std::size_t i = 0; i < count; ++i) tensor.values.push_back(0.2f * random.normal());
  }
  model.tensors["colours.mean"].values.assign(static_cast<std::size_t>(channels), 0.5f);
  model.tensors["colours.low"].values.assign(static_cast<std::size_t>(channels), 0.0f);
  model.tensors["colours.high"].values.assign(static_cast<std::size_t>(channels), 1.0f);
  return model;
}

}  // namespace gramloom
