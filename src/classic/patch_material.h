#pragma once

#include <vector>

#include "classic/patch_features.h"
#include "classic/patchmatch.h"
#include "signal/patch_source.h"
#include "signal/united.h"

namespace gramloom {

/// Up to so many origins are tried for each patch that a fill grows by (patch_growth.h).
inline constexpr double few_origins = 5e4;

/// The exemplars as one picture to copy from, on all levels, finest first.
struct PatchMaterial {
  FeatureAxes axes;
  std::vector<PatchSource> levels;
};

/// `exemplars`: how many are united. There are as many levels as fit exemplar and texture and leave
/// each exemplar some usable origins. Throws Error when the finest one has none.
PatchMaterial make_material(const PatchmatchParams& params, double structure, const United& united,
                            int exemplars, Size texture);

/// How many levels a hole of some width needs: so many that it is narrow, and that there are few
/// places to look for the first of it.
int levels_for(const PatchMaterial& material, int width);

/// The part of the origins that may be used.
double usable_share(const PatchSource& source);

}  // namespace gramloom
