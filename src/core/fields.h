#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/error.h"

namespace gramloom {

/// A field list says once, for each parameter of a method, what the config calls it, what it means
/// and what is allowed. Reading the config, its errors, `gramloom list`, the documentation and the
/// settings saved with each result all come from it.
///
///   struct QuiltingParams {
///     static constexpr std::string_view kind = "quilting";
///     static constexpr std::string_view summary = "patches of the exemplar, cut along …";
///     int patch_size = 32;
///     static constexpr auto fields() {
///       return std::tuple{
///           Field{"patch_size", &QuiltingParams::patch_size, "side of a patch", "pixels", {4,
///           512}}};
///     }
///   };
///
/// A parameter is a bool, int, double, std::string, std::filesystem::path (relative to the config),
/// FileOrName, an enum with `enum_names`, or a std::vector of int, double or std::string.

/// A file, or a bare word, without folder and extension, that the method looks up itself.
struct FileOrName : std::filesystem::path {
  using path::path;
  FileOrName(std::filesystem::path file) : path(std::move(file)) {}

  bool is_name() const { return !empty() && !has_parent_path() && !has_extension(); }
};

/// The words for an enum's values, in their order from 0; specialise it for each enum in a config.
template <class E>
inline constexpr std::array<std::string_view, 0> enum_names{};

template <class E>
concept NamedEnum = std::is_enum_v<E> &&(std::size(enum_names<E>) > 0);

template <NamedEnum E>
constexpr std::string_view to_word(E value) {
  return enum_names<E>[static_cast<std::size_t>(value)];
}

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

namespace detail {
template <class T>
struct ElementOf {
  using type = T;
};
template <class T>
struct ElementOf<std::vector<T>> {
  using type = T;
};
}  // namespace detail

/// T itself, or what a list T holds.
template <class T>
using element_t = typename detail::ElementOf<T>::type;

template <class T>
inline constexpr bool is_number = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Allowed values of a number, or of each number in a list; both ends included.
/// NaN is never allowed, infinity only where an end is infinite.
struct Range {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();

  constexpr bool contains(double value) const { return value >= min && value <= max; }
};

template <class Params, class T>
struct Field {
  using value_type = T;
  std::string_view name;
  T Params::*member;
  std::string_view meaning;
  std::string_view unit = "";  // "" for a pure number or a word
  Range range = {};
};
template <class Params, class T>
Field(const char*, T Params::*, const char*, const char*, Range) -> Field<Params, T>;
template <class Params, class T>
Field(const char*, T Params::*, const char*, const char*) -> Field<Params, T>;
template <class Params, class T>
Field(const char*, T Params::*, const char*) -> Field<Params, T>;

/// Calls f(field) for every field of Params in order.
template <class Params, class F>
void for_each_field(F&& f) {
  std::apply([&](const auto&... field) { (f(field), ...); }, Params::fields());
}

/// "4 to 512", "at least 0", "any number": for messages and documentation.
std::string describe(const Range& range, bool integer);

/// The closest of `words` to `word`, or "" when none is close enough to be a typing mistake.
std::string closest_word(std::string_view word, const std::vector<std::string>& words);

/// Throws ConfigError "name = value: allowed are …" for the first value outside its range. For
/// values that come from code; the config reader does the same with line and column.
template <class Params>
void check_fields(const Params& params) {
  for_each_field<Params>([&](const auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    const auto check = [&](double value) {
      if (!field.range.contains(value))
        throw ConfigError("{} = {}: allowed are {}", field.name, value,
                          describe(field.range, std::is_integral_v<element_t<T>>));
    };
    if constexpr (is_number<T>) {
      check(static_cast<double>(params.*field.member));
    } else if constexpr (is_list<T>) {
      if constexpr (is_number<element_t<T>>)
        for (const auto value : params.*field.member) check(static_cast<double>(value));
    }
  });
}

}  // namespace gramloom
