#pragma once

#include "core/progress.h"
#include "neural/loss/loss_term.h"

namespace gramloom::neural {

/// A network and what of it is matched.
struct MatchedNetwork {
  const Network& network;
  const NetworkDescription& description;
  std::vector<MatchedLayer> layers;
};

/// The terms of the loss that compare feature maps of a network with those of the exemplar. They
/// look at them together: the network is computed once for all of them.
class Features {
 public:
  struct Weighted {
    std::string_view name;
    double weight;
    std::unique_ptr<FeatureTerm> term;
  };

  /// exemplar: (channels, height, width). Edges are what the network sees beyond those of the
  /// exemplar and of the result.
  Features(const MatchedNetwork& network, std::vector<Weighted> terms, at::Tensor exemplar,
           Edges exemplar_edges, Edges edges,
           std::int64_t positions_at_once = most_positions_at_once,
           const Group& group = one_process());

  /// The weighted terms of a picture, of which these rows are this process' own, by name and layer;
  /// adds their gradient. Random directions are those of `step`.
  std::vector<Term> add(const HeldRows& picture, std::uint64_t step, at::Tensor& gradient);
  std::vector<Term> add(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient) {
    return add(all_rows(picture), step, gradient);
  }

 private:
  using Statistics = std::vector<FeatureStatistics>;  // of each term, or nothing for one

  // Those of the terms that are asked.
  Statistics statistics(const SeenRows& rows, Edges edges, std::uint64_t step,
                        const std::vector<bool>& asked) const;
  // Of all rows together, without gradients.
  Statistics total(const PictureRows& rows, Edges edges, std::uint64_t step,
                   const std::vector<bool>& asked) const;
  // The statistics of all processes' rows.
  Statistics summed(Statistics own) const;
  PictureRows rows_of(const HeldRows& picture, Edges edges, const Group& group) const;
  // Their goals become those of that step.
  void look_at_exemplar(std::uint64_t step, const std::vector<bool>& asked);
  // The slopes of all terms along their statistics.
  Statistics compare(const Statistics& whole, std::vector<Term>& terms) const;

  MatchedNetwork network_;
  std::vector<Weighted> terms_;
  std::vector<bool> all_, aim_anew_;  // terms
  at::Tensor exemplar_;
  Edges exemplar_edges_, edges_;
  std::int64_t positions_at_once_;
  const Group& group_;  // the picture is shared out; the exemplar each process has
  std::vector<std::size_t> wanted_;
  std::uint64_t step_ = 0;  // that the goals belong to
};

}  // namespace gramloom::neural
