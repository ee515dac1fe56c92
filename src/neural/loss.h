#pragma once

#include <optional>

#include "core/progress.h"
#include "neural/network.h"
#include "neural/picture_terms.h"
#include "neural/statistics.h"

namespace gramloom::neural {

/// A layer whose Gram matrix is matched, and its weight w_l.
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

/// The weighted sum of NeuralParams' terms for one exemplar and one size of the result.
class Loss {
 public:
  /// target: the result on this level. exemplar: (channels, height, width); its edges and those of
  /// the result are what the network sees beyond them. `network` may be null when gram_weight is 0.
  Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
       Edges exemplar_edges, const Target& target, Edges edges, Random random);

  /// The loss of a picture (channels, height, width) and its gradient. Losses of one step are those
  /// of one function; a step has random directions of its own.
  double operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient);
  /// The weighted terms by name, of the last picture.
  const std::vector<Term>& terms() const { return terms_; }

 private:
  // Adds the Gram matrices' gradient and returns their value.
  double add_grams(const at::Tensor& picture, at::Tensor& gradient);

  const MatchedNetwork* network_;
  GramOptions options_;
  double gram_weight_;
  Edges edges_;
  std::vector<std::size_t> wanted_;
  std::vector<GramTarget> targets_;
  std::vector<std::pair<PictureTerm, double>> others_;  // with their weights
  std::vector<Term> terms_;                             // of the layers, then of the others
};

}  // namespace gramloom::neural
