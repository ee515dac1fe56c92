#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "commands/size_option.h"
#include "commands/usage.h"
#include "io/field_values.h"

namespace gramloom {

// Parameters of a field list as options of a command: "occlusion_radius" is --occlusion-radius, and
// a bool is a flag.

namespace detail {

template <NamedEnum E, class Value>
CLI::Option* add_word_of(CLI::App& command, const std::string& option, Value& value,
                         const std::string& meaning) {
  const std::vector<std::string> words(enum_names<E>.begin(), enum_names<E>.end());
  return command
      .add_option_function<std::string>(
          option,
          [&value, words](const std::string& word) {
            value = static_cast<E>(std::find(words.begin(), words.end(), word) - words.begin());
          },
          meaning)
      ->check(one_of(words))
      ->type_name("");
}

}  // namespace detail

/// An option for one of an enum's words. `value` must stay where it is until the command line is
/// read.
template <NamedEnum E>
CLI::Option* add_word(CLI::App& command, const std::string& option, E& value,
                      const std::string& meaning) {
  return detail::add_word_of<E>(command, option, value, meaning);
}
template <NamedEnum E>
CLI::Option* add_word(CLI::App& command, const std::string& option, std::optional<E>& value,
                      const std::string& meaning) {
  return detail::add_word_of<E>(command, option, value, meaning);
}

namespace detail {

// What CLI11 says after the option's name; "" where every number is allowed.
template <class T>
CLI::Validator range_of(const Range& range) {
  return {[range](const std::string& word) -> std::string {
            double number = 0;
            if (!CLI::detail::lexical_cast(word, number) || range.contains(number)) return "";
            return fmt::format("{} is not {}", word, allowed_values<element_t<T>>(range));
          },
          ""};
}

inline CLI::Option* add_size(CLI::App& command, const std::string& option, Size& value,
                             const Range& range, const std::string& meaning) {
  return command
      .add_option_function<std::string>(
          option,
          [&value, option, range](const std::string& text) {
            value = size_of(option, text, static_cast<int>(range.max));
          },
          fmt::format("{}; {}x{}", meaning, value.width, value.height))
      ->type_name(size_notation);
}

// Repeated, each time with one file.
inline CLI::Option* add_paths(CLI::App& command, const std::string& option,
                              std::vector<std::filesystem::path>& value,
                              const std::string& meaning) {
  return command
      .add_option_function<std::vector<std::string>>(
          option,
          [&value](const std::vector<std::string>& words) {
            value.assign(words.begin(), words.end());
          },
          meaning + "; can be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILE");
}

inline CLI::Option* add_path(CLI::App& command, const std::string& option,
                             std::filesystem::path& value, const std::string& meaning) {
  return command
      .add_option_function<std::string>(
          option, [&value](const std::string& word) { value = word; },
          value.empty() ? meaning : fmt::format("{}; {}", meaning, value.string()))
      ->type_name("");
}

template <class T>
CLI::Option* add_field_option(CLI::App& command, const FieldText& field, T& value) {
  std::string option = fmt::format("--{}", field.name);
  std::replace(option.begin(), option.end(), '_', '-');
  std::string meaning(field.meaning);
  if (!field.unit.empty()) meaning += fmt::format(" ({})", field.unit);
  const std::string standard = value_to_text(value);
  if constexpr (std::is_same_v<T, bool>) {
    const std::string off = value ? fmt::format(",!--no-{}", option.substr(2)) : "";
    return command.add_flag(option + off, value, meaning);
  } else if constexpr (NamedEnum<T>) {
    return add_word(command, option, value, meaning + "; " + std::string(to_word(value)));
  } else if constexpr (is_optional<T>) {
    return add_word(command, option, value, meaning);
  } else if constexpr (std::is_same_v<T, Size>) {
    return add_size(command, option, value, field.range, meaning);
  } else if constexpr (std::is_base_of_v<std::filesystem::path, T>) {
    return add_path(command, option, value, meaning);
  } else if constexpr (std::is_same_v<T, std::vector<std::filesystem::path>>) {
    return add_paths(command, option, value, meaning);
  } else {
    if (standard != "[]") meaning += "; " + standard;
    CLI::Option* added =
        command.add_option(option, value, meaning)->check(range_of<T>(field.range))->type_name("");
    if constexpr (is_list<T>) added->delimiter(',');
    return added;
  }
}

}  // namespace detail

/// `params` must stay where it is until the command line is read. Returns the options.
template <class Params>
std::vector<CLI::Option*> add_field_options(CLI::App& command, Params& params,
                                            const std::string& group) {
  std::vector<CLI::Option*> options;
  for_each_value(params, [&](const FieldText& field, auto& value) {
    options.push_back(detail::add_field_option(command, field, value)->group(group));
  });
  return options;
}

}  // namespace gramloom
