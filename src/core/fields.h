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

/// What is said of a field, whatever its type is.
struct FieldText {
  std::string_view name;
  std::string_view meaning;
  std::string_view unit;  // "" for a pure number or a word
  Range range;
};

template <class Params, class T>
struct Field : FieldText {
  using value_type = T;
  T Params::*member;

  constexpr Field(std::string_view name_, T Params::*member_, std::string_view meaning_,
                  std::string_view unit_ = "", Range range_ = {})
      : FieldText{name_, meaning_, unit_, range_}, member(member_) {}
};

/// Calls f(field) for every field of Params in order.
template <class Params, class F>
void for_each_field(F&& f) {
  std::apply([&](const auto&... field) { (f(field), ...); }, Params::fields());
}

/// Calls f(field, value) for every field's value of `params` in order. What f does should depend on
/// the value's type alone: it is compiled once for each of these, and not for each of Params too.
template <class Params, class F>
void for_each_value(Params& params, F&& f) {
  for_each_field<std::remove_const_t<Params>>(
      [&](const auto& field) { f(static_cast<const FieldText&>(field), params.*field.member); });
}

/// "4 to 512", "at least 0", "any number": for messages and documentation.
std::string describe(const Range& range, bool integer);

/// The closest of `words` to `word`, or "" when none is close enough to be a typing mistake.
std::string closest_word(std::string_view word, const std::vector<std::string>& words);

namespace detail {

void check_number(const FieldText& field, double value, bool integer);

template <class T>
void check_value(const FieldText& field, const T& value) {
  if constexpr (is_number<T>) {
    check_number(field, static_cast<double>(value), std::is_integral_v<T>);
  } else if constexpr (is_list<T>) {
    if constexpr (is_number<element_t<T>>)
      for (const auto element : value) check_value(field, element);
  }
}

}  // namespace detail

/// Throws ConfigError "name = value: allowed are …" for the first value outside its range. For
/// values that come from code; the config reader does the same with line and column.
template <class Params>
void check_fields(const Params& params) {
  for_each_value(
      params, [](const FieldText& field, const auto& value) { detail::check_value(field, value); });
}

}  // namespace gramloom
