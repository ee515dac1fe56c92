#pragma once

#include <vector>

#include "classic/seam.h"
#include "core/image.h"

namespace gramloom {

/// What is there where a pixel of a patch is to be laid.
enum class Ground : unsigned char {
  bare,  // nothing: the patch's pixel is taken
  laid,  // a pixel that may stay or give way
  firm   // a pixel that stays
};

/// How a fresh patch is joined to ground of any shape: the cut of least error through what is laid
/// (Kwatra, Schödl, Essa, Turk, Bobick 2003, "Graphcut textures", equation 1), errors squared as in
/// Efros & Freeman 2001. Departure: seams of earlier patches are not remembered.
/// `ground` has a line more than the patch on each side, row by row.
PatchCut graph_cut(const Image& old, const Image& fresh, const std::vector<Ground>& ground);

}  // namespace gramloom
