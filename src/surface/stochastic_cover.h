#pragma once

#include "core/random.h"
#include "surface/preview.h"

namespace gramloom {

struct Cover {
  PreviewMaterial material;
  double lost = 1;  // by which it is reduced because it would take too much memory
};

/// A material that is to be laid `repeats` times over a shape, as one that is laid once and repeats
/// nothing: all its pictures covered together by stochastic tiling (surface/tiling.h), so that maps
/// stay registered. `rotation`: pieces are turned by up to so many degrees, and normals with them.
/// The result wraps at its edges.
///
/// Its sides have at most `longest` pixels, and all its values stay below 256 MB: beyond, the
/// material is reduced first. Throws Error for maps of different sizes.
Cover covered(const PreviewMaterial& material, Vec2 repeats, double rotation, int longest,
              Random random);

}  // namespace gramloom
