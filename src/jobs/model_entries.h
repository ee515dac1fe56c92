#pragma once

#include <toml++/toml.h>

#include <vector>

#include "jobs/config.h"

namespace gramloom {

/// The [[model]]s of a config whose exemplars are read. Throws ConfigError.
std::vector<ModelEntry> read_models(toml::table& table, const Config& config);

/// Throws ConfigError when the config has models to train, which `train` is for.
void refuse_models(const Config& config, std::string_view command);

}  // namespace gramloom
