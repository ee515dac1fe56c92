#pragma once

#include "core/progress.h"
#include "neural/network.h"
#include "neural/statistics.h"

namespace gramloom::neural {

/// L = Σ w_l E_l over the matched layers of a network, for one exemplar.
class Loss {
 public:
  struct MatchedLayer {
    std::size_t index;
    double weight;
  };

  Loss(const Network& network, const NetworkDescription& description,
       std::vector<MatchedLayer> layers, const GramOptions& options, const at::Tensor& exemplar,
       Edges exemplar_edges, Edges edges);

  /// The loss of a picture (channels, height, width) and its gradient; the terms w_l E_l by name.
  double operator()(const at::Tensor& picture, at::Tensor& gradient);
  const std::vector<Term>& terms() const { return terms_; }

 private:
  const Network& network_;
  std::vector<std::size_t> wanted_;
  std::vector<double> weights_;
  std::vector<GramTarget> targets_;
  std::vector<Term> terms_;
  Edges edges_;
};

}  // namespace gramloom::neural
