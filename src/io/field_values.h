#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/fields.h"
#include "core/image.h"
#include "io/json_text.h"

namespace gramloom {

// What a parameter of each type looks like: in words, as text and as JSON. The types are those of
// core/fields.h, and besides them Size, std::optional (a key that may be left out) and NamedFiles.

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// Files by names of the user's: a table of the config. Each entry is a file, or a table of the
/// fields of `File`, whose first is that file, "image"; the others are optional.
template <class File>
using NamedFiles = std::map<std::string, File>;

template <class T>
inline constexpr bool is_named_files = false;
template <class File>
inline constexpr bool is_named_files<NamedFiles<File>> = true;

/// "a file, or a table of image, kind": what an entry of NamedFiles may be.
template <class File>
std::string allowed_entry() {
  std::string keys;
  for_each_field<File>([&](const auto& field) {
    keys += fmt::format("{}{}", keys.empty() ? "" : ", ", field.name);
  });
  return "a file, or a table of " + keys;
}

template <>
inline constexpr auto enum_names<Tile> = std::to_array<std::string_view>({"none", "x", "y",
                                                                          "both"});

/// What the config may say for a parameter: "a whole number, 4 to 512", "one of none, x, y, both".
template <class T>
std::string allowed_values(const Range& range) {
  constexpr bool integer = std::is_integral_v<element_t<T>>;
  const std::string limits = describe(range, integer);
  const std::string after = limits.starts_with("any") ? "" : ", " + limits;
  if constexpr (is_optional<T>) {
    return allowed_values<typename T::value_type>(range);
  } else if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_same_v<T, Size>) {
    return "[width, height] or one number for both, each " + limits;
  } else if constexpr (is_number<T>) {
    return (integer ? "a whole number" : "a number") + after;
  } else if constexpr (NamedEnum<T>) {
    return fmt::format("one of {}", fmt::join(enum_names<T>, ", "));
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return "a file";
  } else if constexpr (std::is_same_v<T, FileOrName>) {
    return "a name or a file";
  } else if constexpr (is_named_files<T>) {
    return "a table of files: { name = \"file.png\" }";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "a text";
  } else {
    static_assert(is_list<T>, "a parameter has a type that configs do not know");
    return allowed_values<element_t<T>>(range) + ", or a list of these";
  }
}

/// The value as it is saved with a result. Paths are written relative to `folder`, so that the
/// bytes do not depend on where the program was called from.
template <class T>
Json value_to_json(const T& value, const std::filesystem::path& folder) {
  if constexpr (is_optional<T>) {
    return value ? value_to_json(*value, folder) : Json(nullptr);
  } else if constexpr (std::is_same_v<T, Size>) {
    return {value.width, value.height};
  } else if constexpr (std::is_same_v<T, double>) {
    // JSON has no word for infinity.
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    return value;
  } else if constexpr (NamedEnum<T>) {
    return to_word(value);
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    if (value.empty()) return "";
    const auto from = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal();
    return valid_utf8(std::filesystem::absolute(value).lexically_proximate(from).generic_string());
  } else if constexpr (std::is_same_v<T, FileOrName>) {
    if (value.is_name()) return valid_utf8(value.generic_string());
    return value_to_json<std::filesystem::path>(value, folder);
  } else if constexpr (is_named_files<T>) {
    auto files = Json::object();
    for (const auto& [name, file] : value) {
      auto entry = Json::object();
      for_each_value(file, [&](const FieldText& field, const auto& member) {
        if (auto json = value_to_json(member, folder); !json.is_null())
          entry[std::string(field.name)] = std::move(json);
      });
      files[name] = entry.size() == 1 ? entry.front() : entry;  // the file alone, as it was given
    }
    return files;
  } else if constexpr (is_list<T>) {
    auto list = Json::array();
    for (const auto& element : value) list.push_back(value_to_json(element, folder));
    return list;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return valid_utf8(value);
  } else {
    return value;
  }
}

/// The value as a config would write it.
template <class T>
std::string value_to_text(const T& value) {
  const auto json = value_to_json(value, {});
  if (json.is_null()) return "";
  return json == "inf" ? "inf" : to_text(json);
}

}  // namespace gramloom
