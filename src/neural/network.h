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
  Network(const NetworkDescription& description, const std::vector<FilterShape>& shapes,
          std::vector<FilterWeights> weights, Pooling pooling);

  /// The same with each filter scaled so that its mean activation after ReLU on the picture
  /// (channels, height, width) is 1, from the first layer to the last (the normalised network of
  /// Gatys, Ecker, Bethge 2015, section 2). Filters that the picture never excites stay as they
  /// are.
  static Network rescaled(const NetworkDescription& description,
                          const std::vector<FilterShape>& shapes,
                          std::vector<FilterWeights> weights, Pooling pooling,
                          const at::Tensor& picture, Edges edges);

  /// The feature maps of the layers at `wanted` (ascending indices), of one picture
  /// (channels, height, width). Throws Error when a layer would be empty.
  std::vector<Scales> operator()(const at::Tensor& picture, Edges edges,
                                 const std::vector<std::size_t>& wanted) const;

 private:
  struct Branch {  // of a layer with filters
    Convolution convolution;
    double blur;
  };

  // A layer's maps from those of the layer before, or, when there are none, from the picture.
  Scales apply(std::size_t layer, const at::Tensor& picture, const Scales& before, Edges edges,
               bool relu) const;
  // What each branch of a layer with filters gives; joined, they are the layer's maps.
  std::vector<Scales> filter(std::size_t layer, const at::Tensor& picture, const Scales& before,
                             Edges edges, bool relu) const;
  Scales join(std::size_t layer, std::vector<Scales> branches) const;

  void check_size(std::size_t layer, std::int64_t height, std::int64_t width,
                  std::int64_t least_height, std::int64_t least_width,
                  const at::Tensor& picture) const;

  NetworkDescription description_;
  Pooling pooling_;
  std::vector<std::vector<Branch>> branches_;  // by layer
};

}  // namespace gramloom::neural
