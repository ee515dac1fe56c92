#pragma once

namespace gramloom {

/// The first pixel of a patch in the exemplar.
struct PatchOrigin {
  int x = 0;
  int y = 0;

  friend bool operator==(const PatchOrigin&, const PatchOrigin&) = default;
};

}  // namespace gramloom
