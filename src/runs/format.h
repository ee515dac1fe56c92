#pragma once

#include <filesystem>
#include <string>

#include "io/json_fields.h"
#include "io/text_file.h"

namespace gramloom {

// The JSON files of a run. Each is a struct with a field list, `version`, which counts the changes
// of the format, and `what`, for errors. The rules:
// - the version stands first in the file; one without is of version 1, before there were numbers.
// - Keys that this program does not know are skipped: a newer one wrote them.
// - A file of an older version may lack keys; their fields keep their defaults. `upgrade` brings
//   the JSON of an older version into the present form, where names or shapes have changed.
// - A file of a newer version is read as far as it goes; where that fails the error says so.

template <class T>
concept Format = HasFields<T> && requires {
  T::version;
  T::what;
};

template <Format T>
std::string format_to_text(const T& value) {
  Json json{{"version", T::version}};
  json.update(to_json_value(value));
  return to_text(json, 2) + "\n";
}

/// Throws Error: one line with file and key.
template <Format T>
T format_from_json(Json json, const std::string& file) {
  if (!json.is_object()) throw Error("{}: is not {}", file, T::what);
  const int version =
      json.contains("version")
          ? from_json_value<int>(json["version"], JsonPlace{file}.at("version"), {1, 1e9})
          : 1;
  if constexpr (requires { T::upgrade(json, file); })
    if (version < T::version) T::upgrade(json, file);
  try {
    return from_json_value<T>(json, {file, "", version < T::version});
  } catch (const Error& error) {
    if (version <= T::version) throw;
    throw Error("{} (a newer gramloom wrote it: version {}, this one knows {})", error.what(),
                version, T::version);
  }
}

/// Throws Error: one line with the file, and the key where there is one.
template <Format T>
T read_format(const std::filesystem::path& file) {
  return format_from_json<T>(read_json(file), file.string());
}

/// Complete or not at all. Throws Error.
template <Format T>
void write_format(const std::filesystem::path& file, const T& value) {
  write_text(file, format_to_text(value));
}

}  // namespace gramloom
