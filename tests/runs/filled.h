#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/json_fields.h"

namespace gramloom {

/// A value in which nothing has its default: each field, through the field lists, has another one.
template <class T>
T filled(int& count) {
  ++count;
  if constexpr (std::is_same_v<T, Json>) {
    return {{"key", {{"deeper", count}}}};
  } else if constexpr (HasFields<T>) {
    T value;
    for_each_field<T>([&](const auto& field) {
      using Value = typename std::decay_t<decltype(field)>::value_type;
      value.*field.member = filled<Value>(count);
    });
    return value;
  } else if constexpr (is_optional<T>) {
    return filled<typename T::value_type>(count);
  } else if constexpr (is_map<T>) {
    const std::string first = fmt::format("b \"{}\"", count);
    return {{first, filled<typename T::value_type::second_type>(count)},
            {"a", filled<typename T::value_type::second_type>(count)}};
  } else if constexpr (is_list<T>) {
    return {filled<element_t<T>>(count), filled<element_t<T>>(count)};
  } else if constexpr (std::is_same_v<T, Size>) {
    return {count, 2 * count};
  } else if constexpr (NamedEnum<T>) {
    return static_cast<T>(1);
  } else if constexpr (std::is_same_v<T, double>) {
    return 1 / (count + 2.0);
  } else if constexpr (is_number<T>) {
    return count;
  } else {
    return fmt::format("text {}, \"quoted\"\nand \xE7\xA0\x82", count);
  }
}

}  // namespace gramloom
