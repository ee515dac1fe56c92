#pragma once

#include <vector>

#include "core/image.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// How much of the patch at each position of an exemplar has been used, in patches: a laid patch
/// counts by the part of its area that it shares.
class PatchReuse {
 public:
  PatchReuse(Size positions, Size patch);

  void add(PatchOrigin laid);
  /// errors += weight · use, for each position, row by row.
  void add_to(std::vector<float>& errors, float weight) const;

 private:
  Size positions_;
  Size patch_;
  std::vector<float> use_;
};

}  // namespace gramloom
