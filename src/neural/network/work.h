#pragma once

#include <vector>

#include "neural/network/network_description.h"

namespace gramloom {

/// A layer whose statistics are matched, and its weight w_l.
struct MatchedLayer {
  std::size_t index;
  double weight;
};

/// Positions of a picture whose feature maps are in memory at once. Statistics are sums over
/// positions, or sorts of few values for each, so a larger picture is looked at a few rows at a
/// time, each time with the rows around them that their maps depend on, and twice: for the
/// statistics, and for their gradient. There is at least one row of the smallest maps.
inline constexpr std::int64_t most_positions_at_once = std::int64_t{1} << 18;

/// What a network does with a picture of that size, and its maps in memory.
struct NetworkWork {
  double filters = 0;   // operations of one pass and its gradient
  double products = 0;  // of each matched map with each other, also those of finer scales
  double products_within_scales = 0;
  double values = 0;     // of all layers' maps, each as often as it is computed
  double kept = 0;       // values that the gradient needs
  double largest = 0;    // values of the largest layer
  double matched = 0;    // values of the matched layers
  double positions = 0;  // of the matched layers
  double weights = 0;

  double bytes() const { return sizeof(float) * (1.5 * kept + 5 * largest); }
  double bytes_without_gradient() const { return sizeof(float) * (kept + 3 * largest); }
};

NetworkWork network_work(const NetworkDescription& network, const std::vector<FilterShape>& shapes,
                         const std::vector<MatchedLayer>& matched, Size picture, int channels);

}  // namespace gramloom
