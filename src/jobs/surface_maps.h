#pragma once

#include <string>
#include <vector>

#include "core/request.h"
#include "jobs/config.h"
#include "jobs/plan.h"

namespace gramloom {

/// Adds the maps that the config's [surface] asks for, made of the texture's height, which is
/// guessed if that asks for it; without one, a note says so. Throws Error for a height of several
/// channels that differ.
void add_surface_maps(Texture& texture, const Config& config, const Job& job,
                      std::vector<std::string>& notes);

}  // namespace gramloom
