#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"

namespace gramloom::neural {

/// Values in rows of one length: of each place what its guide is.
struct GuideRows {
  std::int64_t length = 0;
  std::vector<float> values;

  std::int64_t count() const { return length > 0 ? std::ssize(values) / length : 0; }
  const float* at(std::int64_t i) const { return values.data() + i * length; }
};

/// Draws for each place of a result one of an exemplar with a like guide: with a probability
/// proportional to exp(−w² (d² − e²) / 0.02), d² the mean squared difference over the quarters of a
/// patch (quarter_means.h), summed over the guide's channels, and e² that of the places most alike.
/// Places of nearly one guide are looked at together, in a few thousand groups.
class GuideDraws {
 public:
  /// weights: of each wanted place.
  GuideDraws(const GuideRows& exemplar, const GuideRows& wanted, const std::vector<float>& weights);

  /// A place of the exemplar, for that wanted one.
  std::int64_t draw(std::int64_t wanted, Random& random) const;
  /// w² e²: how unlike the places are that are most alike.
  float unlike(std::int64_t wanted) const;
  /// Forgets all wanted places but these, which are numbered anew.
  void keep(const std::vector<std::int64_t>& wanted);

 private:
  std::vector<std::vector<std::int32_t>> cells_;  // places of the exemplar of like guides
  std::vector<std::int32_t> group_;               // of each wanted place
  std::vector<std::vector<float>> below_;  // of each group: the probability of each cell and those
                                           // before it
  std::vector<float> unlike_;              // of each group
};

/// Places of nearly one guide: the group of each, in at most that many groups.
struct GuideGroups {
  std::vector<std::int32_t> group;
  GuideRows middle;  // of each group

  /// The group whose middle is the nearest.
  std::int32_t nearest(const float* guide) const;
};
GuideGroups group_guides(const GuideRows& rows, std::size_t most);

}  // namespace gramloom::neural
