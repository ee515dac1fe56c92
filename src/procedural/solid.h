#pragma once

#include <array>
#include <span>

#include "procedural/texture.h"

namespace gramloom {

/// A solid texture at single points, in features: a picture of one row with a pixel for each, or
/// none. A point (x, y, z) is what synthesise() has at (x, y) of a picture at depth z. `width`: of
/// what each stands for. Throws ConfigError as synthesise() does, and for a texture that is flat or
/// has 4 dimensions.
Image colours_at(const ProceduralParams& params, std::span<const std::array<float, 3>> points,
                 float width, Random random);

}  // namespace gramloom
