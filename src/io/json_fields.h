#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/field_values.h"
#include "io/json_text.h"

namespace gramloom {

// Structs become JSON objects and come back through their field lists, as TOML tables do
// (toml_reader.h). Besides the types of a config, a field may be a struct with a field list, a
// std::map or Named of any of these, or Json itself.

template <class T>
concept HasFields = requires {
  T::fields();
};

/// Values by name, in their own order: a JSON object.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

template <class T>
inline constexpr bool is_map = false;
template <class T>
inline constexpr bool is_map<std::map<std::string, T>> = true;
template <class T>
inline constexpr bool is_map<Named<T>> = true;

template <class T>
Json to_json_value(const T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    return value;
  } else if constexpr (HasFields<T>) {
    auto object = Json::object();
    for_each_value(value, [&](const FieldText& field, const auto& member) {
      object[std::string(field.name)] = to_json_value(member);
    });
    return object;
  } else if constexpr (is_optional<T>) {
    return value ? to_json_value(*value) : Json(nullptr);
  } else if constexpr (is_map<T>) {
    auto object = Json::object();
    for (const auto& [name, element] : value) object[valid_utf8(name)] = to_json_value(element);
    return object;
  } else if constexpr (is_list<T>) {
    auto list = Json::array();
    for (const auto& element : value) list.push_back(to_json_value(element));
    return list;
  } else {
    return value_to_json(value, {});
  }
}

/// Where a value stands, for errors: "out/run.json: 'jobs/e/q/seed1/status' …".
struct JsonPlace {
  std::string file;
  std::string key = "";
  bool may_lack_keys = false;  // then a missing key keeps the default of its field

  JsonPlace at(std::string_view part) const {
    return {file, key.empty() ? std::string(part) : fmt::format("{}/{}", key, part), may_lack_keys};
  }
};

/// Throws Error "FILE: 'key' is a text, allowed is a whole number".
[[noreturn]] void wrong_json(const Json& json, const JsonPlace& place, const std::string& allowed);
/// Throws Error for a key that is not there.
const Json& required_key(const Json& object, std::string_view key, const JsonPlace& place);

namespace detail {
double read_json_number(const Json& json, const JsonPlace& place, const Range& range,
                        const std::string& allowed);
std::int64_t read_json_integer(const Json& json, const JsonPlace& place, const Range& range,
                               const std::string& allowed);
std::size_t read_json_word(const Json& json, const JsonPlace& place,
                           const std::vector<std::string_view>& words, const std::string& allowed);
}  // namespace detail

/// The value that to_json_value() wrote. Throws Error in one line with file and key for what is
/// missing, of another type or out of range. Keys that are no field are not looked at.
template <class T>
T from_json_value(const Json& json, const JsonPlace& place, const Range& range = {}) {
  if constexpr (std::is_same_v<T, Json>) {
    return json;
  } else if constexpr (HasFields<T>) {
    if (!json.is_object()) wrong_json(json, place, "an object");
    T value;
    for_each_value(value, [&]<class Value>(const FieldText& field, Value& member) {
      const std::string name(field.name);
      if (!json.contains(name) && (is_optional<Value> || place.may_lack_keys)) return;
      member = from_json_value<Value>(required_key(json, name, place), place.at(name), field.range);
    });
    return value;
  } else if constexpr (is_optional<T>) {
    if (json.is_null()) return std::nullopt;
    return from_json_value<typename T::value_type>(json, place, range);
  } else if constexpr (is_map<T>) {
    if (!json.is_object()) wrong_json(json, place, "an object");
    T map;
    for (const auto& [name, element] : json.items())
      map.insert(map.end(), {name, from_json_value<typename T::value_type::second_type>(
                                       element, place.at(name), range)});
    return map;
  } else if constexpr (is_list<T>) {
    if (!json.is_array()) wrong_json(json, place, "a list");
    T list;
    for (const auto& element : json)
      list.push_back(
          from_json_value<element_t<T>>(element, place.at(fmt::format("{}", list.size())), range));
    return list;
  } else if constexpr (std::is_same_v<T, Size>) {
    const auto sides = from_json_value<std::vector<int>>(json, place, range);
    if (sides.size() != 2) wrong_json(json, place, "[width, height]");
    return {sides[0], sides[1]};
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean()) wrong_json(json, place, allowed_values<T>(range));
    return json.get<bool>();
  } else if constexpr (std::is_integral_v<T>) {
    static_assert(std::is_same_v<T, int> || std::is_same_v<T, std::int64_t>);
    const Range limits{std::max(range.min, double{std::numeric_limits<int>::min()}),
                       std::min(range.max, double{std::numeric_limits<int>::max()})};
    return static_cast<T>(detail::read_json_integer(
        json, place, std::is_same_v<T, int> ? limits : range, allowed_values<T>(range)));
  } else if constexpr (std::is_same_v<T, double>) {
    return detail::read_json_number(json, place, range, allowed_values<T>(range));
  } else if constexpr (NamedEnum<T>) {
    return static_cast<T>(detail::read_json_word(
        json, place, {enum_names<T>.begin(), enum_names<T>.end()}, allowed_values<T>(range)));
  } else {
    static_assert(std::is_same_v<T, std::string>, "a field has a type that JSON files do not know");
    if (!json.is_string()) wrong_json(json, place, allowed_values<T>(range));
    return json.get<std::string>();
  }
}

}  // namespace gramloom
