#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "jobs/methods.h"

namespace gramloom {

/// The method of a [[method]] table: its `kind`, its parameters, and those of its sub-method.
/// Throws ConfigError.
Method read_method(const toml::table& table);

/// The method of this kind with "key=value" for its parameters, as --set has them; `texture` is
/// that of a procedural one, else "". Throws ConfigError.
Method method_of(const std::string& kind, const std::string& texture,
                 const std::vector<std::string>& set);

/// The keys that the method of this table may have, or none when its kind is not known.
std::vector<std::string> method_keys(const toml::table& table);

}  // namespace gramloom
