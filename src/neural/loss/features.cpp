#include "neural/loss/features.h"

#include <c10/core/GradMode.h>
#include <torch/csrc/autograd/autograd.h>

#include <algorithm>
#include <optional>

namespace gramloom::neural {

std::vector<at::Tensor> FeatureStatistics::sums() const {
  std::vector<at::Tensor> result;
  for (const auto& of_layer : moments) {
    result.insert(result.end(), {of_layer.gram, of_layer.mean});
    for (const auto& shifted : of_layer.shifted) result.push_back(shifted.products);
  }
  return result;
}

std::vector<Rows> FeatureTerm::needed(const std::vector<Size>&, const std::vector<Rows>& own,
                                      Tile) const {
  return own;
}

Features::Features(const MatchedNetwork& network, std::vector<Weighted> terms, at::Tensor exemplar,
                   Edges exemplar_edges, Edges edges, std::int64_t positions_at_once,
                   const Group& group)
    : network_(network),
      terms_(std::move(terms)),
      all_(terms_.size(), true),
      exemplar_(std::move(exemplar)),
      exemplar_edges_(exemplar_edges),
      edges_(edges),
      positions_at_once_(positions_at_once),
      group_(group) {
  for (const auto& layer : network.layers) wanted_.push_back(layer.index);
  for (const auto& [name, weight, term] : terms_) aim_anew_.push_back(term->aims_anew());
  look_at_exemplar(0, all_);
}

Features::Statistics Features::statistics(const SeenRows& rows, Edges edges, std::uint64_t step,
                                          const std::vector<bool>& asked) const {
  Statistics result(terms_.size());
  for (std::size_t t = 0; t < terms_.size(); ++t)
    if (asked[t]) result[t] = terms_[t].term->statistics(rows, wrapped_axes(edges), step);
  return result;
}

Features::Statistics Features::total(const PictureRows& rows, Edges edges, std::uint64_t step,
                                     const std::vector<bool>& asked) const {
  const c10::NoGradGuard no_gradients;
  Statistics whole;
  std::vector<std::vector<std::vector<at::Tensor>>> values(terms_.size());  // of each share
  for (std::int64_t share = 0; share < rows.shares(); ++share) {
    const Statistics own = statistics(rows.see(share), edges, step, asked);
    if (share == 0) whole = own;
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      const auto sums = whole[t].sums(), more = own[t].sums();
      for (std::size_t i = 0; share > 0 && i < sums.size(); ++i) sums[i].add_(more[i]);
      values[t].resize(own[t].values.size());
      for (std::size_t i = 0; i < own[t].values.size(); ++i)
        values[t][i].push_back(own[t].values[i]);
    }
  }
  for (std::size_t t = 0; t < terms_.size(); ++t)
    for (std::size_t i = 0; i < values[t].size(); ++i) {
      whole[t].values[i] = at::cat(values[t][i], 1);
      values[t][i].clear();  // as large again
    }
  return whole;
}

Features::Statistics Features::summed(Statistics own) const {
  if (group_.alone()) return own;
  std::vector<at::Tensor> sums;
  for (FeatureStatistics& statistics : own)
    for (Moments& moments : statistics.moments) {
      const auto copied = [&](at::Tensor& sum) {  // which may be part of a graph
        sums.push_back(sum = sum.detach().clone(at::MemoryFormat::Contiguous));
      };
      copied(moments.gram);
      copied(moments.mean);
      for (auto& shifted : moments.shifted) copied(shifted.products);
    }
  sum_all(group_, sums);
  return own;
}

PictureRows Features::rows_of(const HeldRows& picture, Edges edges, const Group& group) const {
  const auto needed = [this, edges](const std::vector<Size>& sizes, const std::vector<Rows>& own) {
    std::vector<Rows> result = own;
    for (const auto& [name, weight, term] : terms_) {
      const auto more = term->needed(sizes, own, wrapped_axes(edges));
      for (std::size_t k = 0; k < result.size(); ++k) result[k] = hull(result[k], more[k]);
    }
    return result;
  };
  return {network_.network, wanted_, picture, edges, needed, positions_at_once_, group};
}

void Features::look_at_exemplar(std::uint64_t step, const std::vector<bool>& asked) {
  Statistics goal = total(rows_of(all_rows(exemplar_), exemplar_edges_, one_process()),
                          exemplar_edges_, step, asked);
  for (std::size_t t = 0; t < terms_.size(); ++t)
    if (asked[t]) terms_[t].term->aim_at(std::move(goal[t]));
  step_ = step;
}

Features::Statistics Features::compare(const Statistics& whole, std::vector<Term>& terms) const {
  Statistics slopes(terms_.size());
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const auto& [kind, weight, term] = terms_[t];
    std::vector<double> weights;
    for (const auto& layer : network_.layers) weights.push_back(layer.weight * weight);
    const auto errors = term->compare(whole[t], weights, slopes[t]);
    for (std::size_t l = 0; l < errors.size(); ++l)
      terms.push_back(
          {fmt::format("{}_{}", kind, network_.description.layers[wanted_[l]].name), errors[l]});
  }
  return slopes;
}

std::vector<Term> Features::add(const HeldRows& picture, std::uint64_t step, at::Tensor& gradient) {
  if (step != step_ && std::count(aim_anew_.begin(), aim_anew_.end(), true) > 0)
    look_at_exemplar(step, aim_anew_);
  const c10::AutoGradMode gradients(true);
  const PictureRows rows = rows_of(picture, edges_, group_);
  // First the statistics of all rows, then the gradient of each share. A single one is kept
  // between.
  std::optional<SeenRows> only;
  if (rows.shares() == 1) only = rows.see(0);
  const Statistics all =
      only ? statistics(*only, edges_, step, all_) : total(rows, edges_, step, all_);
  std::vector<Term> terms;
  const Statistics slopes = compare(summed(all), terms);

  std::vector<at::Tensor> of_scales = rows.zeros();
  std::vector<std::vector<std::int64_t>> seen(terms_.size());  // positions of the shares before
  for (std::size_t t = 0; t < terms_.size(); ++t) seen[t].resize(slopes[t].values.size());
  for (std::int64_t share = 0; share < rows.shares(); ++share) {
    const SeenRows now = only ? *only : rows.see(share);
    const Statistics own = only ? all : statistics(now, edges_, step, all_);
    std::vector<at::Tensor> outputs, upstream;
    const auto pull = [&](const at::Tensor& output, const at::Tensor& slope) {
      // No own row has a partner at that shift, or the exemplar is too small for it.
      if (!output.requires_grad() || !slope.defined()) return;
      outputs.push_back(output);
      upstream.push_back(slope);
    };
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      const auto sums = own[t].sums(), of_sums = slopes[t].sums();
      for (std::size_t i = 0; i < sums.size(); ++i) pull(sums[i], of_sums[i]);
      for (std::size_t i = 0; i < own[t].values.size(); ++i) {
        const std::int64_t count = own[t].values[i].size(1);
        pull(own[t].values[i], slopes[t].values[i].narrow(1, seen[t][i], count));
        seen[t][i] += count;
      }
    }
    rows.add(now, torch::autograd::grad(outputs, now.inputs, upstream), of_scales);
  }
  gradient.add_(rows.of_picture(of_scales));
  return terms;
}

}  // namespace gramloom::neural
