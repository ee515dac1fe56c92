#pragma once

#include <optional>

#include "core/progress.h"
#include "core/random.h"
#include "neural/loss/picture_parts.h"

namespace gramloom::neural {

/// A layer whose statistics are matched, and its weight w_l.
struct MatchedLayer {
  std::size_t index;
  double weight;
};

/// A network and what of it is matched.
struct MatchedNetwork {
  const Network& network;
  const NetworkDescription& description;
  std::vector<MatchedLayer> layers;
};

/// The terms of the loss that compare feature maps of a network with those of the exemplar, for
/// each matched layer:
///   gram             their Gram matrices, statistics.h;
///   sliced_features  the sliced Wasserstein distance of their values at all positions of a scale,
///                    along random directions in the space of channels (Heitz, Vanhoey, Chambon,
///                    Belcour 2021, equations 4 to 6, with W₁ for W₂), divided by the exemplar's
///                    own distance from its mean; averaged over the scales of a pyramid.
class NetworkTerms {
 public:
  /// exemplar: (channels, height, width). Edges are what the network sees beyond those of the
  /// exemplar and of the result.
  NetworkTerms(const NeuralParams& params, const MatchedNetwork& network, at::Tensor exemplar,
               Edges exemplar_edges, Edges edges, Random random,
               std::int64_t positions_in_band = most_positions_in_band);

  /// The weighted terms of a picture by name; adds their gradient. The directions are those of
  /// `step`.
  std::vector<Term> add(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient);

 private:
  struct Statistics {
    std::vector<Moments> moments;          // of each layer
    std::vector<at::Tensor> projections;   // (directions, positions) of each layer, of each scale
    std::vector<at::Tensor> sums() const;  // all tensors of the moments
  };

  // What the rows of a part contribute.
  Statistics statistics(const PicturePart& part, Edges edges, std::uint64_t step,
                        bool with_moments) const;
  // Of all parts together, without gradients.
  Statistics total(const PictureParts& parts, Edges edges, std::uint64_t step,
                   bool with_moments) const;
  // The exemplar's statistics; the goals become those of that step.
  Statistics look_at_exemplar(std::uint64_t step, bool with_moments);
  // The weighted term of a layer, and its slopes along all tensors that it is made of.
  double gram_term(std::size_t layer, const Moments& own, std::vector<at::Tensor>& slopes) const;
  double sliced_term(std::size_t layer, std::size_t first, std::size_t count,
                     const Statistics& whole, std::vector<at::Tensor>& slopes) const;

  MatchedNetwork network_;
  double gram_weight_, sliced_weight_;
  GramOptions options_;
  int directions_;
  Edges exemplar_edges_, edges_;
  Random random_;
  std::int64_t positions_in_band_;
  at::Tensor exemplar_;
  std::vector<std::size_t> wanted_;
  std::vector<GramTarget> grams_;
  std::vector<at::Tensor> goals_;      // the exemplar's projections, sorted
  std::vector<double> flat_;           // the mean distance of each of them from its mean
  std::optional<std::uint64_t> step_;  // that the goals belong to
};

}  // namespace gramloom::neural
