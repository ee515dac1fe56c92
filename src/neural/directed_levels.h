#pragma once

#include "neural/guidance.h"
#include "neural/params.h"

namespace gramloom::neural {

/// Of `levels` for an exemplar of that size, those that guidance leaves: they end where fewer than
/// a few of the largest patches lie wholly in usable pixels, or, where holes are to be filled,
/// where the widest of them is as narrow as a patch. As many as `params` asks for, if it does.
int directed_levels(const NeuralParams& params, const Guidance& guidance, Size exemplar,
                    int levels);

}  // namespace gramloom::neural
