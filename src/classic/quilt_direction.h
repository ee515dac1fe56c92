#pragma once

#include <optional>
#include <vector>

#include "classic/overlap_weighted.h"
#include "core/request.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// Where the patches of a quilt may come from, and how well each of these places follows the
/// target's guide.
class QuiltDirection {
 public:
  /// `guide`: what the target asks of the exemplar's guide, of the target's size or empty; `weight`
  /// as Target::guide_weight. Both must outlive this. Throws Error where no whole patch is usable.
  QuiltDirection(const Exemplar& exemplar, const Image& guide, const Image& weight, Size patch);

  bool guided() const { return guide_errors_.has_value(); }

  /// Places whose patch is not usable get an error above all others. With a guide, errors +=
  /// unit · mean of weight² · |difference of guides|² over the patch at `place` of the target, or
  /// over those of its pixels whose `made` is not 0 if that is not empty.
  void add_to(std::vector<float>& errors, PatchOrigin place, float unit,
              const std::vector<float>& made = {}) const;

 private:
  const Image& guide_;
  const Image& weight_;
  Size patch_;
  std::vector<unsigned char> usable_;  // empty: all are
  std::optional<WeightedErrors> guide_errors_;
};

/// The side of the largest square of usable pixels.
int largest_usable_square(const Image& mask);

}  // namespace gramloom
