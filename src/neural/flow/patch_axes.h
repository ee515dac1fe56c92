#pragma once

#include <vector>

#include "core/image.h"
#include "core/random.h"
#include "neural/flow/nearest.h"

namespace gramloom::neural {

/// Upper left pixel of a patch.
struct PatchPlace {
  int x = 0, y = 0;
};

/// A projection of patches of side × side pixels, less no mean, on orthonormal axes.
struct PatchAxes {
  int side = 0;
  Vectors axes;  // each side · side · channels long, in the order of an image's values
};

/// The `count` principal axes of the image's patches, taken from a few thousand of them; fewer if a
/// patch has fewer values. Throws Error when no patch fits.
PatchAxes patch_axes(const Image& image, int side, int count, Random random);
/// Likewise, taken from some of these places.
PatchAxes patch_axes(const Image& image, int side, int count, Random random,
                     const std::vector<PatchPlace>& places);

/// The patches at these places along the axes. Patches go on across the edges that wrap. The same
/// bytes for any number of threads.
Vectors project(const Image& image, const std::vector<PatchPlace>& places, const PatchAxes& axes);

/// Places of all patches inside an image of that size.
Size patch_places(Size image, int side);

}  // namespace gramloom::neural
