#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "jobs/config.h"

namespace gramloom {

/// The [[exemplar]]s of a config. Throws ConfigError.
std::vector<ExemplarEntry> read_exemplars(toml::table& config);

/// Whether an exemplar can be called so: `name` is a folder beside the files of the run. Throws
/// ConfigError with the place.
void check_exemplar_name(const std::string& name, const toml::source_region& region);

[[noreturn]] void fail_taken_name(const std::string& name, const toml::source_region& region);

/// Names of maps are parts of files' names, and their files are there. Throws ConfigError.
void check_maps(const NamedFiles<MapFile>& maps, const toml::source_region& region);

/// Of a mask, no other word than "alpha" is a name. Throws ConfigError.
void check_mask(const FileOrName& mask, const toml::source_region& region);
bool is_alpha(const FileOrName& mask);

}  // namespace gramloom
