#include "neural/loss/mix_bins.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace gramloom::neural {

namespace {

constexpr int steps = 8;

std::vector<float> normalised(std::vector<float> shares) {
  const float sum = std::accumulate(shares.begin(), shares.end(), 0.0f);
  for (float& share : shares) share /= sum;
  return shares;
}

bool is_one_row(const GuideRows& rows) {
  for (std::int64_t i = 1; i < rows.count(); ++i)
    if (!std::equal(rows.at(0), rows.at(0) + rows.length, rows.at(i))) return false;
  return true;
}

// Shares as numbers of steps, each moved up or down by less than one. What is pure stays so.
std::vector<int> strewn(const float* shares, std::size_t count, float by) {
  std::vector<int> result;
  for (std::size_t e = 0; e < count; ++e) {
    const bool pure = shares[e] < 1e-3f || shares[e] > 0.999f;
    const float moved = shares[e] * steps + (pure ? 0 : e % 2 == 0 ? by : -by);
    result.push_back(std::clamp(static_cast<int>(std::lround(moved)), 0, steps));
  }
  if (std::ranges::max(result) == 0)
    result[static_cast<std::size_t>(std::max_element(shares, shares + count) - shares)] = 1;
  return result;
}

}  // namespace

std::vector<MixBin> mix_bins(const GuideRows& shares, const Indices& sample, Random random) {
  if (shares.length == 0 || is_one_row(shares)) {
    Indices all(sample.size());
    std::iota(all.begin(), all.end(), 0);
    if (shares.length == 0) return {{{1.0f}, all}};
    return {{normalised({shares.at(0), shares.at(0) + shares.length}), all}};
  }
  std::map<std::vector<int>, Indices> bins;
  for (std::size_t i = 0; i < sample.size(); ++i)
    bins[strewn(shares.at(sample[i]), static_cast<std::size_t>(shares.length),
                random.uniform() - 0.5f)]
        .push_back(static_cast<std::int64_t>(i));
  std::vector<MixBin> result;
  for (auto& [key, members] : bins)
    result.push_back({normalised({key.begin(), key.end()}), std::move(members)});
  return result;
}

}  // namespace gramloom::neural
