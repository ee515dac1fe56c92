#include "neural/loss/network_terms.h"

#include <torch/csrc/autograd/autograd.h>

#include "neural/loss/wasserstein.h"

namespace gramloom::neural {

std::vector<at::Tensor> NetworkTerms::Statistics::sums() const {
  std::vector<at::Tensor> result;
  for (const auto& of_layer : moments) {
    result.insert(result.end(), {of_layer.gram, of_layer.mean});
    for (const auto& shifted : of_layer.shifted) result.push_back(shifted.products);
  }
  return result;
}

NetworkTerms::NetworkTerms(const NeuralParams& params, const MatchedNetwork& network,
                           at::Tensor exemplar, Edges exemplar_edges, Edges edges, Random random,
                           std::int64_t positions_in_band)
    : network_(network),
      gram_weight_(params.gram_weight),
      sliced_weight_(params.sliced_features_weight),
      options_{params.normalise, params.centre, params.standardise, params.shifts},
      directions_(params.directions),
      exemplar_edges_(exemplar_edges),
      edges_(edges),
      random_(random),
      positions_in_band_(positions_in_band),
      exemplar_(std::move(exemplar)) {
  for (const auto& layer : network.layers) wanted_.push_back(layer.index);
  const Statistics goal = look_at_exemplar(0, gram_weight_ > 0);
  for (const auto& moments : goal.moments) grams_.emplace_back(moments, options_);
  for (const auto& sorted : goals_) {
    const double flat = distance_from_mean(sorted) / directions_;
    // Of equal values the mean is rounded.
    flat_.push_back(flat < 1e-6 * sorted.square().mean().sqrt().item<double>() ? 0 : flat);
  }
}

NetworkTerms::Statistics NetworkTerms::statistics(const PicturePart& part, Edges edges,
                                                  std::uint64_t step, bool with_moments) const {
  Statistics result;
  for (std::size_t l = 0; l < part.maps.size(); ++l) {
    if (with_moments)
      result.moments.push_back(
          moments(part.maps[l], part.own[l], wrapped_axes(edges), options_.shifts));
    if (sliced_weight_ > 0)
      for (std::size_t k = 0; k < part.maps[l].size(); ++k) {
        const Band& band = part.maps[l][k];
        const at::Tensor rows =
            to_rows({take_rows(band, part.own[l][k], Padding::circular), band.channels});
        result.projections.push_back(
            at::mm(random_directions(random_.stream(step).stream(result.projections.size()),
                                     directions_, band.channels),
                   rows.t()));
      }
  }
  return result;
}

NetworkTerms::Statistics NetworkTerms::total(const PictureParts& parts, Edges edges,
                                             std::uint64_t step, bool with_moments) const {
  const c10::NoGradGuard no_gradients;
  Statistics sum;
  std::vector<std::vector<at::Tensor>> projections;  // of each part
  for (std::int64_t i = 0; i < parts.count(); ++i) {
    const Statistics own = statistics(parts.part(i), edges, step, with_moments);
    if (i == 0) sum.moments = own.moments;
    const auto sums = sum.sums(), more = own.sums();
    for (std::size_t t = 0; i > 0 && t < sums.size(); ++t) sums[t].add_(more[t]);
    projections.resize(own.projections.size());
    for (std::size_t j = 0; j < projections.size(); ++j)
      projections[j].push_back(own.projections[j]);
  }
  for (auto& of_map : projections) {
    sum.projections.push_back(at::cat(of_map, 1));
    of_map.clear();  // as large again
  }
  return sum;
}

NetworkTerms::Statistics NetworkTerms::look_at_exemplar(std::uint64_t step, bool with_moments) {
  const PictureParts parts(network_.network, wanted_, exemplar_, exemplar_edges_, options_.shifts,
                           positions_in_band_);
  Statistics goal = total(parts, exemplar_edges_, step, with_moments);
  goals_ = goal.projections;
  for (auto& values : goals_) sort_rows(values);
  step_ = step;
  return goal;
}

double NetworkTerms::gram_term(std::size_t layer, const Moments& own,
                               std::vector<at::Tensor>& slopes) const {
  Statistics leaf{{own}, {}};
  Moments& m = leaf.moments[0];
  m.gram = m.gram.detach().requires_grad_(true);
  m.mean = m.mean.detach().requires_grad_(true);
  for (auto& shifted : m.shifted) shifted.products = shifted.products.detach().requires_grad_(true);
  const at::Tensor term =
      grams_[layer].distance(m) * (network_.layers[layer].weight * gram_weight_);
  for (const auto& slope : torch::autograd::grad({term}, leaf.sums(), {}, {}, false, true))
    slopes.push_back(slope);
  return term.item<double>();
}

double NetworkTerms::sliced_term(std::size_t layer, std::size_t first, std::size_t count,
                                 const Statistics& whole, std::vector<at::Tensor>& slopes) const {
  double term = 0;
  for (std::size_t map = first; map < first + count; ++map) {
    at::Tensor values = whole.projections[map];  // overwritten, where no gradient needs them
    if (values.requires_grad()) values = values.detach().clone(at::MemoryFormat::Contiguous);
    const double weight = flat_[map] > 0 ? network_.layers[layer].weight * sliced_weight_ /
                                               (flat_[map] * static_cast<double>(count))
                                         : 0;
    term += weight * wasserstein(values, goals_[map]);
    slopes.push_back(values.mul_(weight));
  }
  return term;
}

std::vector<Term> NetworkTerms::add(const at::Tensor& picture, std::uint64_t step,
                                    at::Tensor& gradient) {
  if (sliced_weight_ > 0 && step != step_) look_at_exemplar(step, false);
  const c10::AutoGradMode gradients(true);
  const PictureParts parts(network_.network, wanted_, picture, edges_, options_.shifts,
                           positions_in_band_);
  // First the statistics of all parts, then the gradient of each. A single part is kept between.
  std::optional<PicturePart> only;
  Statistics whole;
  if (parts.count() == 1) {
    only = parts.part(0);
    whole = statistics(*only, edges_, step, gram_weight_ > 0);
  } else {
    whole = total(parts, edges_, step, gram_weight_ > 0);
  }

  std::vector<Term> terms;
  std::vector<at::Tensor> of_sums, of_projections;
  const auto name = [&](const char* kind, std::size_t layer) {
    return fmt::format("{}_{}", kind, network_.description.layers[wanted_[layer]].name);
  };
  for (std::size_t l = 0; l < whole.moments.size(); ++l)
    terms.push_back({name("gram", l), gram_term(l, whole.moments[l], of_sums)});
  const std::size_t views = whole.projections.size() / wanted_.size();
  for (std::size_t l = 0; views > 0 && l < wanted_.size(); ++l)
    terms.push_back(
        {name("sliced_features", l), sliced_term(l, l * views, views, whole, of_projections)});

  std::vector<at::Tensor> of_views = parts.zeros();
  std::vector<std::int64_t> seen(of_projections.size());  // positions of the parts before
  for (std::int64_t i = 0; i < parts.count(); ++i) {
    const PicturePart part = only ? *only : parts.part(i);
    const Statistics own = only ? whole : statistics(part, edges_, step, gram_weight_ > 0);
    std::vector<at::Tensor> outputs, slopes;
    const auto pull = [&](const at::Tensor& output, const at::Tensor& slope) {
      // No row of the part has a partner at that shift, or the exemplar is too small for it.
      if (!output.requires_grad() || !slope.defined()) return;
      outputs.push_back(output);
      slopes.push_back(slope);
    };
    const auto sums = own.sums();
    for (std::size_t t = 0; t < sums.size(); ++t) pull(sums[t], of_sums[t]);
    for (std::size_t j = 0; j < own.projections.size(); ++j) {
      const std::int64_t count = own.projections[j].size(1);
      pull(own.projections[j], of_projections[j].narrow(1, seen[j], count));
      seen[j] += count;
    }
    parts.add(part, torch::autograd::grad(outputs, part.strips, slopes), of_views);
  }
  gradient.add_(parts.of_picture(of_views));
  return terms;
}

}  // namespace gramloom::neural
