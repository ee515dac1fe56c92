#pragma once

#include <string>
#include <vector>

#include "procedural/solid.h"
#include "surface/preview.h"

namespace gramloom {

/// What carves a shape from a procedural texture: each point evaluated in the solid. Throws
/// ConfigError for a texture that is flat.
Solid solid_of(const ProceduralParams& params, Random random);

/// A procedural texture by its name, with "key=value" for its parameters, for a preview of that
/// size: as a solid, or else as a picture that tiles, with its maps. Throws ConfigError.
PreviewMaterial procedural_material(const std::string& name, const std::vector<std::string>& set,
                                    bool solid, Size preview);

}  // namespace gramloom
