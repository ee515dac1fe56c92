#pragma once

#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/error.h"

namespace gramloom {

// JSON as text: every JSON text that gramloom reads or writes goes through here.

/// JSON whose keys stay in the order in which they were set.
using Json = nlohmann::ordered_json;

/// Throws Error for text whose lists and objects are nested deeper than 100: what works with a
/// parsed value calls itself once a level, and a file must not choose how deep our stack goes.
void check_nesting(std::string_view json);

/// What an exception says, in one line; the JSON library's without the name that it has there
/// ("[json.exception.type_error.302] ").
std::string message_of(const std::exception& error);

/// The value that `text` holds. Throws Error for text that is no JSON or nested too deeply; it says
/// where, but not in which file. `watch` sees each part as it is parsed (see nlohmann-json).
template <class Value = Json>
Value parse_json(std::string_view text, const typename Value::parser_callback_t& watch = nullptr) {
  check_nesting(text);
  try {
    return Value::parse(text.begin(), text.end(), watch);
  } catch (const nlohmann::json::exception& error) {
    throw Error("{}", message_of(error));
  }
}

/// The value in a file. Throws Error with the path, also for a file that cannot be read.
Json read_json(const std::filesystem::path& path);

/// `value` in one line, or over several with `indent` spaces a level. A text in it that is not
/// UTF-8 (a file's name may be any bytes) has a replacement character for each odd byte. `ascii`:
/// other letters become \u escapes.
template <class Value>
std::string to_text(const Value& value, int indent = -1, bool ascii = false) {
  return value.dump(indent, ' ', ascii, Value::error_handler_t::replace);
}

/// `text` as to_text() writes it and parse_json() reads it back: each byte that is not UTF-8 is a
/// replacement character.
std::string valid_utf8(const std::string& text);

}  // namespace gramloom
