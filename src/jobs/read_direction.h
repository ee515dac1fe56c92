#pragma once

#include <toml++/toml.h>

#include "jobs/config.h"

namespace gramloom {

/// [guide], [mix], [turn] and [fill] of a config. Throws ConfigError.
Direction read_direction(toml::table& config);

/// What follows from them for the rest: the size and the edges of the texture, and the exemplar of
/// a [fill] that has no other. Looks at the size of a picture. Throws ConfigError.
void follow_direction(Config& config, toml::table& table);

}  // namespace gramloom
