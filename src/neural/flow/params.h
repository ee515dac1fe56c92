#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// Settings of patch flow matching (flow/patch_flow.h). Lists are read from the finest octave on;
/// the last value also holds for all coarser ones.
struct FlowParams {
  double originality = 0.8;
  std::vector<int> flow_patch_sizes{8, 8, 12};
  std::vector<int> flow_steps{6, 8, 16};
  std::vector<double> flow_renoise{0.65, 0.6};
  std::vector<int> flow_neighbours{3, 4, 4};
  double flow_price = 0.2;

  /// Of the exemplar's patches, those drawn anew for each step among which neighbours are looked
  /// for, in a picture of so many pixels.
  std::int64_t references(std::int64_t patches, double pixels) const;
  /// The share of patches that are offered what they came from in the last step.
  double remembered() const { return std::clamp((0.7 - originality) / 0.7, 0.0, 1.0); }

  static constexpr auto fields() {
    using P = FlowParams;
    return std::tuple{
        Field{"originality",
              &P::originality,
              "of a layout by flow: 1 is the freest; towards 0 more of the exemplar's patches are "
              "looked at, then larger pieces are copied, and it is more like the exemplar",
              "",
              {0, 1}},
        Field{"flow_patch_sizes",
              &P::flow_patch_sizes,
              "sides of the layout's patches; lists are read from the finest octave on, and the "
              "last value is also for all coarser ones",
              "pixels",
              {2, 32}},
        Field{"flow_steps",
              &P::flow_steps,
              "steps from noise to picture on each octave",
              "",
              {1, 1000}},
        Field{"flow_renoise",
              &P::flow_renoise,
              "how much of the coarser octave's picture an octave starts from; the rest is noise",
              "",
              {0, 0.99}},
        Field{"flow_neighbours",
              &P::flow_neighbours,
              "exemplar patches that each patch becomes a mean of",
              "",
              {1, 64}},
        Field{"flow_price",
              &P::flow_price,
              "how fast an exemplar patch that is used too often becomes dearer; 0: never",
              "",
              {0, 10}}};
  }
};

/// From 1 in 50 at originality 1 to all, but at least 1500 to 6500, and at most 16384, less in
/// pictures above 512², so that time grows no faster than they do.
inline std::int64_t FlowParams::references(std::int64_t patches, double pixels) const {
  constexpr double most = 16384, most_in_large = 2500, large = 512.0 * 512.0;
  const double limit = std::clamp(most * large / pixels, most_in_large, most);
  const double least = std::min(limit, 1500 + 5000 * (1 - originality));
  const double share = std::pow(0.02, originality);
  return std::min(patches, static_cast<std::int64_t>(
                               std::clamp(share * static_cast<double>(patches), least, limit)));
}

}  // namespace gramloom
