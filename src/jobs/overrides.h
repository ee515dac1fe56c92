#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace gramloom {

/// The top-level keys of a config.
std::vector<std::string> config_keys();

/// The tables of the [[section]] list of a config, "exemplar" or "method". Throws ConfigError when
/// it is no list of tables.
std::vector<toml::table*> section(toml::table& config, std::string_view name);

/// The tables of a section that may be one, [section], or several, [[section]].
std::vector<toml::table*> tables_of(toml::table& config, std::string_view name);

/// The [section] table of a config, or none. Throws ConfigError when it is no table.
toml::table* single_section(toml::table& config, std::string_view name);

/// Puts "key=value" into the config's tables, in place of what they say. Throws ConfigError when
/// there is nothing that has such a key.
void apply_override(toml::table& config, const std::string& option);

}  // namespace gramloom
