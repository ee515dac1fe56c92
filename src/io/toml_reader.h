#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/variants.h"
#include "io/field_values.h"

namespace gramloom {

// TOML tables become structs through the structs' field lists. Every mistake is a ConfigError that
// begins with its place: "configs/a.toml:12:3: " or "--set patch_size=-1: ".

/// `text` as TOML; `name` is what errors call it. Throws ConfigError.
toml::table parse_toml(std::string_view text, const std::string& name);

/// An override's table, whose nodes carry "--set key=value" as their place. `text` is taken as TOML
/// where it is some, and as a word otherwise.
toml::table parse_override(std::string_view key, std::string_view text, const std::string& option);

/// "configs/a.toml:12:3" or "--set key=value".
std::string place(const toml::source_region& region);

template <class... Args>
[[noreturn]] void fail(const toml::source_region& region, fmt::format_string<Args...> text,
                       Args&&... args) {
  const std::string before = region.path ? place(region) + ": " : "";  // words have no place
  throw ConfigError("{}{}", before, fmt::format(text, std::forward<Args>(args)...));
}

/// Throws for the first key of `table` that is not among `known`.
void check_keys(const toml::table& table, const std::vector<std::string>& known);

/// The place of `key`, or of the table when it lacks the key.
const toml::source_region& key_region(const toml::table& table, std::string_view key);

/// `word` as the index of one of `words`; fails with a suggestion.
std::size_t index_of_word(const std::string& word, const std::vector<std::string>& words,
                          std::string_view key, const toml::source_region& region);

namespace detail {

// Where a value stands and what is allowed there.
struct Slot {
  std::string_view key;
  Range range;
  toml::source_region region;
};

[[noreturn]] void wrong_type(const toml::node& node, const Slot& slot, const std::string& allowed);
std::int64_t read_integer(const toml::node& node, const Slot& slot, const std::string& allowed);
double read_number(const toml::node& node, const Slot& slot, const std::string& allowed);
std::string read_string(const toml::node& node, const Slot& slot, const std::string& allowed);
std::filesystem::path read_path(const toml::node& node, const Slot& slot,
                                const std::string& allowed);
FileOrName read_file_or_name(const toml::node& node, const Slot& slot, const std::string& allowed);

template <class Files>
Files read_files(const toml::node& node, const Slot& slot, const std::string& allowed);

template <class T>
T read_value(const toml::node& node, const Slot& slot, const std::string& allowed) {
  if constexpr (is_optional<T>) {
    return read_value<typename T::value_type>(node, slot, allowed);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!node.is_boolean()) wrong_type(node, slot, allowed);
    return *node.value<bool>();
  } else if constexpr (std::is_same_v<T, int>) {
    return static_cast<int>(read_integer(node, slot, allowed));
  } else if constexpr (std::is_same_v<T, double>) {
    return read_number(node, slot, allowed);
  } else if constexpr (std::is_same_v<T, Size>) {
    if (!node.is_array()) {
      const int side = static_cast<int>(read_integer(node, slot, allowed));
      return {side, side};
    }
    const auto sides = read_value<std::vector<int>>(node, slot, allowed);
    if (sides.size() != 2)
      fail(slot.region, "'{}' has {} numbers, allowed is {}", slot.key, sides.size(), allowed);
    return {sides[0], sides[1]};
  } else if constexpr (NamedEnum<T>) {
    const std::vector<std::string> words(enum_names<T>.begin(), enum_names<T>.end());
    return static_cast<T>(
        index_of_word(read_string(node, slot, allowed), words, slot.key, slot.region));
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return read_path(node, slot, allowed);
  } else if constexpr (std::is_same_v<T, FileOrName>) {
    return read_file_or_name(node, slot, allowed);
  } else if constexpr (is_named_files<T>) {
    return read_files<T>(node, slot, allowed);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return read_string(node, slot, allowed);
  } else {
    using Element = element_t<T>;
    if (!node.is_array()) return {read_value<Element>(node, slot, allowed)};
    T list;
    for (const auto& element : *node.as_array())
      list.push_back(read_value<Element>(element, {slot.key, slot.range, element.source()},
                                         allowed_values<Element>(slot.range)));
    return list;
  }
}

template <class T>
void read_field(const toml::table& table, const FieldText& field, T& value) {
  if (const toml::node* node = table.get(field.name))
    value = read_value<T>(*node, {field.name, field.range, key_region(table, field.name)},
                          allowed_values<T>(field.range));
}

}  // namespace detail

/// The names of Params' fields, after `others`.
template <class Params>
std::vector<std::string> key_names(std::vector<std::string> others = {}) {
  for_each_field<Params>([&](const auto& field) { others.emplace_back(field.name); });
  return others;
}

/// `params` with what `table` says for those of its fields whose names are `wanted`.
template <class Params, class Wanted>
void read_fields_if(Params& params, const toml::table& table, Wanted&& wanted) {
  for_each_value(params, [&](const FieldText& field, auto& value) {
    if (wanted(field.name)) detail::read_field(table, field, value);
  });
}

/// `params` with what `table` says for its fields; keys that are no field are not looked at.
template <class Params>
void read_fields(Params& params, const toml::table& table) {
  read_fields_if(params, table, [](std::string_view) { return true; });
}

/// The text under `key`, which must be there and not empty.
std::string required_text(const toml::table& table, std::string_view key);

/// The file or the folder that `node`, a text, names; likewise relative. `allowed` is for a node of
/// another type.
std::filesystem::path read_file_or_folder(const toml::node& node, std::string_view key,
                                          const std::string& allowed);

/// The folder under `key`, which must be there; relative to the config's, or of --set to the
/// current one.
std::filesystem::path required_folder(const toml::table& table, std::string_view key);

namespace detail {

template <class Files>
Files read_files(const toml::node& node, const Slot& slot, const std::string& allowed) {
  using File = typename Files::mapped_type;
  if (!node.is_table()) wrong_type(node, slot, allowed);
  Files files;
  for (const auto& [key, value] : *node.as_table()) {
    File& file = files[std::string(key.str())];
    if (const toml::table* table = value.as_table()) {
      check_keys(*table, key_names<File>());
      required_text(*table, "image");
      read_fields(file, *table);
    } else {
      file.image = read_path(value, {key.str(), {}, key.source()}, allowed_entry<File>());
    }
  }
  return files;
}

}  // namespace detail

/// The index of the alternative of the variant V whose `name` stands under `key`.
template <class V>
std::size_t read_alternative(const toml::table& table, std::string_view key) {
  std::vector<std::string> names;
  for_each_alternative<V>([&]<class T>(std::type_identity<T>) { names.emplace_back(T::name); });
  return index_of_word(required_text(table, key), names, key, key_region(table, key));
}

}  // namespace gramloom
