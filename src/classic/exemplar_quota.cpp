#include "classic/exemplar_quota.h"

#include <algorithm>

namespace gramloom {

namespace {

/// At an eighth beyond its part an exemplar is as bad as one that has nothing in common.
constexpr double steepness = 8;
constexpr double least_share = 1e-6;

double usable_pixels(const Exemplar& exemplar) {
  if (exemplar.mask.empty()) return 1.0 * exemplar.image.width * exemplar.image.height;
  return static_cast<double>(
      std::ranges::count_if(exemplar.mask.pixels, [](float m) { return m > 0.5f; }));
}

}  // namespace

ExemplarQuota::ExemplarQuota(const Request& request, const United& united) {
  const Target& target = request.target;
  const bool even = target.weights.empty() || target.weights.size() == Size{1, 1};
  if (request.exemplars.size() == 1 || !even || !target.guide.empty() || !target.known.empty())
    return;
  for (std::size_t i = 0; i < request.exemplars.size(); ++i)
    shares_.push_back(target.weights.empty() ? usable_pixels(request.exemplars[i])
                                             : double{target.weights.pixels[i]});
  double all = 0;
  for (const double share : shares_) all += share;
  for (double& share : shares_) share = std::max(share / all, least_share);
  made_.assign(shares_.size(), 0);
  for (int x = 0; x < united.exemplar().image.width; ++x)
    exemplar_.push_back(united.source(x, 0).exemplar);
}

std::vector<float> ExemplarQuota::costs() const {
  std::vector<float> costs;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    costs.push_back(static_cast<float>(steepness * std::max(0.0, made_[i] / shares_[i] - 1)));
  return costs;
}

}  // namespace gramloom
