#pragma once

#include <optional>

#include "core/progress.h"
#include "core/request.h"
#include "neural/loss/features.h"

namespace gramloom::neural {

/// The weighted sum of NeuralParams' terms for one exemplar and one size of the result.
class Loss {
 public:
  /// target: the result on this level. exemplar: (channels, height, width); its edges and those of
  /// the result are what the network sees beyond them. `network` may be null when no term needs it.
  Loss(const NeuralParams& params, const MatchedNetwork* network, const at::Tensor& exemplar,
       Edges exemplar_edges, const Target& target, Edges edges, Random random,
       const Guidance* guidance = nullptr, const at::Tensor& nearest = {},
       const Group& group = one_process());

  /// The loss of a picture (channels, height, width), of which a process has its own rows, and the
  /// gradient of these. Losses of one step are those of one function; a step has random directions
  /// of its own.
  double operator()(const at::Tensor& picture, std::uint64_t step, at::Tensor& gradient);
  /// The weighted terms by name, of the last picture: those that look at a network first.
  const std::vector<Term>& terms() const { return terms_; }

 private:
  struct Weighted {
    std::string_view name;
    double weight;
    std::unique_ptr<PictureTerm> term;
  };

  const Group& group_;
  std::int64_t height_;  // of the whole picture
  std::optional<Features> features_;
  std::vector<Weighted> pictures_;
  std::vector<Term> terms_;
};

}  // namespace gramloom::neural
