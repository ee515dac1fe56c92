#pragma once

#include "neural/convolution.h"
#include "neural/network_description.h"

namespace gramloom::neural {

/// Weights of one filter bank: (outputs, inputs, kernel, kernel), and (outputs) or undefined.
struct FilterWeights {
  at::Tensor weights;
  at::Tensor bias;
};

/// One for each of filter_shapes(), drawn from the seed: He normal (He, Zhang, Ren, Sun 2015,
/// variance 2/(inputs·kernel²)), or orthogonal filters of the same energy (Saxe, McClelland,
/// Ganguli 2014). No bias.
std::vector<FilterWeights> random_filters(const std::vector<FilterShape>& shapes,
                                          RandomWeights kind, std::uint64_t seed);

/// From a .safetensors file with torchvision's names: features.N.weight and features.N.bias, N
/// counting convolutions, ReLUs and pools from 0. Throws Error with file and tensor for a tensor
/// that is missing or of another shape.
std::vector<FilterWeights> load_filters(const NetworkDescription& description,
                                        const std::vector<FilterShape>& shapes,
                                        const std::filesystem::path& file);

/// A network ready to look at pictures.
class Network {
 public:
  Network(const NetworkDescription& description, std::vector<FilterShape> shapes,
          std::vector<FilterWeights> weights, Pooling pooling);

  /// The feature maps of the layers at `wanted` (ascending indices), of one picture
  /// (channels, height, width). Throws Error when a layer would be empty.
  std::vector<FeatureMaps> operator()(const at::Tensor& planes, Edges edges,
                                      const std::vector<std::size_t>& wanted) const;

  /// Scales each filter so that its mean activation after ReLU on the picture is 1, from the first
  /// layer to the last (the normalised network of Gatys, Ecker, Bethge 2015, section 2). Filters
  /// that the picture never excites stay as they are.
  void rescale(const at::Tensor& planes, Edges edges);

 private:
  FeatureMaps apply(std::size_t layer, const at::Tensor& planes, const FeatureMaps& maps,
                    Edges edges, bool relu) const;
  void build();

  NetworkDescription description_;
  std::vector<FilterShape> shapes_;
  std::vector<FilterWeights> weights_;
  Pooling pooling_;
  std::vector<Convolution> convolutions_;  // one for each of shapes_
  std::vector<std::size_t> first_;         // by layer: index of its first filter bank
};

}  // namespace gramloom::neural
