#pragma once

#include "core/image.h"
#include "neural/guidance.h"

namespace gramloom::neural {

/// Holes filled with pieces of the exemplar from their edges inwards (Criminisi, Pérez, Toyama
/// 2004, "Region filling and object removal by exemplar-based image inpainting"): what a fill
/// begins with on its coarsest level. Of all patches about a pixel at an edge the next is that of
/// the greatest confidence times strength of what runs into the edge; it is laid from the usable
/// patch that is nearest on its known pixels. With a guide its distance joins that one. No larger
/// than `side`. The same bytes for any number of threads. picture, exemplar: of the sizes that the
/// guidance is of.
Image first_fill(const Guidance& guidance, Image picture, const Image& exemplar, int side);

}  // namespace gramloom::neural
