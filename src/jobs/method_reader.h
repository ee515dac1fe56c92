#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "jobs/methods.h"

namespace gramloom {

/// The method of a [[method]] table: its `kind`, its parameters, and those of its sub-method.
/// Throws ConfigError.
Method read_method(const toml::table& table);

/// The keys that the method of this table may have, or none when its kind is not known.
std::vector<std::string> method_keys(const toml::table& table);

}  // namespace gramloom
