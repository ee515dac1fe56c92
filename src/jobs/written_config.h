#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "jobs/config.h"

namespace gramloom {

// Configs that commands write themselves, and what those share that do the one job of such a
// config: `fill` and `make`. Their files have absolute paths.

/// A text as TOML writes it. Throws ConfigError for one that is not UTF-8.
std::string quoted(const std::string& text);
/// A file by its absolute path.
std::string quoted_path(const std::filesystem::path& file);
/// "[a, b]" of several.
std::string quoted_paths(const std::vector<std::filesystem::path>& files);
/// { "height" = "FILE" } of maps.
std::string named_files_in_config(const NamedFiles<MapFile>& files);
/// What an exemplar of this picture is called: like its file, where its results can be.
std::string exemplar_name(const std::filesystem::path& picture);
/// A value as a config of any folder says it; "" of one that is not set.
template <class T>
std::string value_in_config(const T& value) {
  if constexpr (std::is_same_v<T, FileOrName>) {
    if (value.is_name()) return quoted(value.string());
    return value.empty() ? "" : quoted_path(value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return value.empty() ? "" : quoted_path(value);
  } else if constexpr (std::is_same_v<T, std::vector<std::filesystem::path>>) {
    return value.empty() ? "" : quoted_paths(value);
  } else if constexpr (is_named_files<T>) {
    return value.empty() ? "" : named_files_in_config(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return value.empty() ? "" : quoted(value);
  } else if constexpr (is_list<T>) {
    return value.empty() ? "" : value_to_text(value);
  } else {
    return value_to_text(value);
  }
}

/// Adds the line of a value, if it is set.
template <class T>
void add_line(const FieldText& field, const T& value, std::string& lines) {
  if (const std::string text = value_in_config(value); !text.empty())
    lines += fmt::format("{} = {}\n", field.name, text);
}

/// The fields of a struct that are set, a line each.
template <class Struct>
std::string lines_in_config(const Struct& params) {
  std::string lines;
  for_each_value(params,
                 [&](const FieldText& field, const auto& value) { add_line(field, value, lines); });
  return lines;
}

/// parse_config() of a text that the user has not written and does not see: its errors say what is
/// wrong, but not in which line.
Config parse_unseen_config(const std::string& text, const std::filesystem::path& file);

/// The parameter `key` of a method as a config of any folder says it; "" of one that is not set.
std::string parameter_text(const Method& method, std::string_view key);

/// Throws Error when a picture cannot be written to `output`: there is no such folder, it would
/// write over a file of the config's, or replace one whose metadata lacks `mark`.
void check_result(const std::filesystem::path& output, const Config& config,
                  const std::string& mark);

/// A texture that is finished: throws Interrupted also where a method would give what it has.
Texture finished_texture(const Method& method, const Request& request, const Control& control);

}  // namespace gramloom
