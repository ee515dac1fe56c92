#pragma once

#include <vector>

#include "neural/guide_draws.h"

namespace gramloom::neural {

using Indices = std::vector<std::int64_t>;

/// Patches of a result that are compared with a goal of their own: those of about one mix.
struct MixBin {
  std::vector<float> shares;  // of the exemplars, their sum is 1
  Indices members;            // among the patches of the sample
};

/// Patches `sample` of those whose shares are given, about one mix together, in steps of an eighth:
/// each goes to one of the two nearest steps at random, so that no step is seen. Of one mix
/// everywhere, and without shares, all are together.
std::vector<MixBin> mix_bins(const GuideRows& shares, const Indices& sample, Random random);

}  // namespace gramloom::neural
