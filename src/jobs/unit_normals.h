#pragma once

#include <vector>

#include "core/request.h"

namespace gramloom {

/// Brings the layers of normals of a method's texture to unit length, in the convention of their
/// exemplar: what a method mixes, filters or optimises is shorter. Normals that a method copied
/// stay as they are, to the last bit.
void keep_normals_unit(Texture& texture, const std::vector<Exemplar>& exemplars);

}  // namespace gramloom
