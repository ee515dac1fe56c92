#include "io/json_fields.h"

#include <algorithm>

namespace gramloom {

namespace {

std::string what_it_is(const Json& json) {
  switch (json.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list";
    default:
      // Short enough for a line.
      const std::string text = to_text(json);
      return text.size() <= 40 ? text : json.is_string() ? "a long text" : "a long number";
  }
}

}  // namespace

void wrong_json(const Json& json, const JsonPlace& place, const std::string& allowed) {
  if (place.key.empty())
    throw Error("{}: is {}, allowed is {}", place.file, what_it_is(json), allowed);
  throw Error("{}: '{}' is {}, allowed is {}", place.file, place.key, what_it_is(json), allowed);
}

const Json& required_key(const Json& object, std::string_view key, const JsonPlace& place) {
  const auto found = object.find(key);
  if (found == object.end()) throw Error("{}: '{}' is missing", place.file, place.at(key).key);
  return *found;
}

namespace detail {

double read_json_number(const Json& json, const JsonPlace& place, const Range& range,
                        const std::string& allowed) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();  // JSON has no word for it
  if (json == "inf") return infinity;
  if (json == "-inf") return -infinity;
  if (!json.is_number() || !range.contains(json.get<double>())) wrong_json(json, place, allowed);
  return json.get<double>();
}

std::int64_t read_json_integer(const Json& json, const JsonPlace& place, const Range& range,
                               const std::string& allowed) {
  // A whole number beyond 64 bits is a floating-point number to the library.
  const bool fits = json.is_number_integer() &&
                    (!json.is_number_unsigned() ||
                     json.get<std::uint64_t>() <=
                         static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
  if (!fits || !range.contains(json.get<double>())) wrong_json(json, place, allowed);
  return json.get<std::int64_t>();
}

std::size_t read_json_word(const Json& json, const JsonPlace& place,
                           const std::vector<std::string_view>& words, const std::string& allowed) {
  const auto found = json.is_string()
                         ? std::find(words.begin(), words.end(), json.get<std::string>())
                         : words.end();
  if (found == words.end()) wrong_json(json, place, allowed);
  return static_cast<std::size_t>(found - words.begin());
}

}  // namespace detail

}  // namespace gramloom
