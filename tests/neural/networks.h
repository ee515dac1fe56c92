#pragma once

#include "neural/network/network.h"

namespace gramloom::neural {

/// Three sizes of the picture, and a layer that acts on each.
inline NetworkDescription pyramid_network() {
  NetworkDescription network;
  network.name = "pyramid";
  network.layers = {{"pyramid1", PyramidLayer{5, 3, 3}},
                    {"relu1", ReluLayer{}},
                    {"conv2", ConvolutionLayer{4, 3, 1}},
                    {"relu2", ReluLayer{}}};
  return network;
}

/// With random filters, for pictures of two channels of that type.
inline Network random_network(const NetworkDescription& description, at::ScalarType type,
                              Pooling pooling = Pooling::as_described) {
  const auto shapes = filter_shapes(description, 2);
  auto weights = random_filters(shapes, RandomWeights::he_normal, 3);
  for (auto& w : weights) w.weights = w.weights.to(type);
  return {description, shapes, weights, pooling};
}

}  // namespace gramloom::neural
