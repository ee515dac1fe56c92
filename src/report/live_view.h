#pragma once

#include "runs/run_folder.h"

namespace gramloom {

/// What the page needs to make a job's picture itself, live: {file, tile}, where `file` is a
/// script, relative to the run's folder, that hands it the shaders of the job's generator
/// (learnt/export_glsl.h). Null for jobs of other kinds, shares that change from place to place,
/// shaders of more than live_view_limit bytes, and where neither the script nor the model, as the
/// job read it, is there any more. Jobs of one model share a script. Throws Error.
Json live_view(const RunOnDisk& run, const JobOnDisk& job);

inline constexpr std::size_t live_view_limit = 2'000'000;

}  // namespace gramloom
