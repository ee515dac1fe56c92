#pragma once

#include <span>

#include "neural/network/convolution.h"
#include "neural/network/network_description.h"
#include "neural/network/rows.h"

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

  // The same a few rows at a time: any rows of any layer can be had without the others.

  /// What the first layer looks at: the picture, or, for a pyramid, the picture at each of its
  /// sizes, resampled from one to the next. All other layers act on each of these scales alone.
  std::vector<at::Tensor> scales(const at::Tensor& picture, Edges edges) const;
  std::vector<Size> scale_sizes(Size picture) const;
  /// The size of each layer's maps of a scale of that size. Throws Error when one would be empty.
  std::vector<Size> sizes(Size scale, Edges edges) const;
  /// The rows of such a scale that `rows` of the layers `wanted` are made of, one for each of them.
  Rows rows_of_scale(Size scale, Edges edges, const std::vector<std::size_t>& wanted,
                     const std::vector<Rows>& rows) const;
  /// The maps of these rows, given at least those of scale number `index`.
  std::vector<HeldRows> maps_of_rows(std::size_t index, const HeldRows& scale, Edges edges,
                                     const std::vector<std::size_t>& wanted,
                                     const std::vector<Rows>& rows) const;

 private:
  struct Branch {  // of a layer with filters
    Convolution convolution;
    double blur;
  };

  bool is_pyramid(std::size_t layer) const;
  // Those that look at that scale.
  std::span<const Branch> branches(std::size_t layer, std::size_t scale) const;
  std::int64_t radius(std::size_t layer) const;
  // For each layer up to the last wanted one, the rows of its maps that are needed.
  std::vector<Rows> needed(const std::vector<Size>& sizes, Edges edges,
                           const std::vector<std::size_t>& wanted,
                           const std::vector<Rows>& rows) const;
  // The rows of what the layer looks at, `height` high, that `rows` of its maps are made of.
  Rows inputs(std::size_t layer, Rows rows, std::int64_t height, std::int64_t own_height,
              Edges edges) const;
  // `rows` of a layer's maps from what it looks at.
  HeldRows apply(std::size_t layer, std::size_t scale, const HeldRows& input, Rows rows,
                 std::int64_t own_height, Edges edges, bool relu) const;
  HeldRows convolved(std::size_t layer, std::size_t scale, const HeldRows& input, Rows rows,
                     std::int64_t own_height, Edges edges, bool relu) const;
  HeldRows pooled(std::size_t layer, const HeldRows& input, Rows rows, std::int64_t own_height,
                  Edges edges) const;

  NetworkDescription description_;
  Pooling pooling_;
  std::vector<std::vector<Branch>> branches_;  // by layer
};

}  // namespace gramloom::neural
