#pragma once

#include "classic/patchmatch.h"
#include "core/cost.h"

namespace gramloom {

/// Whether a request asks for more than a texture of one exemplar: several exemplars, a mask, a
/// guide, weights or a fill.
bool is_directed(const RequestSize& request);

/// The texture of such a request.
Texture directed_patchmatch(const PatchmatchParams& params, const Request& request,
                            const Control& control);
Cost estimate_directed(const PatchmatchParams& params, const RequestSize& request);

}  // namespace gramloom
