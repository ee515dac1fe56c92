#include "io/toml_reader.h"

#include <algorithm>
#include <cstdint>

#include "io/pictures_in_memory.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view set_option = "--set ";

bool is_override(const toml::source_region& region) {
  return region.path && region.path->starts_with(set_option);
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

[[noreturn]] void out_of_range(const auto& value, const detail::Slot& slot) {
  constexpr bool integer = std::is_integral_v<std::decay_t<decltype(value)>>;
  fail(slot.region, "'{}' = {}: allowed are {}", slot.key, value, describe(slot.range, integer));
}

// The folder that paths at this place are relative to: the config's, or for --set the current one.
fs::path folder_of(const toml::source_region& region) {
  return region.path && !is_override(region) ? fs::path(*region.path).parent_path() : fs::path();
}

constexpr int deepest_table = 50;

// The end of the text (or comment) that begins at `at`, as TOML has them.
std::size_t end_of_text(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (quote == '#') return std::min(text.find('\n', at), text.size());
  const std::string_view three = text.substr(at, 3);
  const bool long_text = three.size() == 3 && three[1] == quote && three[2] == quote;
  for (at += long_text ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\\' && quote == '"')
      ++at;
    else if (long_text ? text.substr(at, 3) == three : text[at] == quote || text[at] == '\n')
      return at + (long_text ? 3 : 1);
  }
  return text.size();
}

// What works with tables calls itself once a level, toml++ too, and a file must not choose how deep
// our stack goes: neither by brackets nor by keys of many parts.
void check_toml_nesting(std::string_view text, const std::string& name) {
  int brackets = 0;
  int dots = 0;  // of the key at hand
  std::uint32_t line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'' || c == '#') {
      const std::size_t end = end_of_text(text, at);
      line += static_cast<std::uint32_t>(
          std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                     text.begin() + static_cast<std::ptrdiff_t>(std::min(end, text.size())), '\n'));
      at = end;
      continue;
    }
    if (c == '\n') ++line;
    if (c == '\n' || c == '=' || c == ',') dots = 0;
    if (c == '.') ++dots;
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') --brackets;
    if (brackets > deepest_table || dots > deepest_table)
      throw ConfigError("{}:{}: nested deeper than {}", name, line, deepest_table);
    ++at;
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
  check_toml_nesting(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    fail(error.source(), "{}", error.description());
  }
}

toml::table parse_override(std::string_view key, std::string_view text, const std::string& option) {
  const std::string name = std::string(set_option) + option;
  toml::table parsed;
  try {
    check_toml_nesting(text, name);
    parsed = toml::parse(fmt::format("value = {}", text), name);
  } catch (const toml::parse_error&) {
  } catch (const ConfigError&) {
  }
  if (parsed.size() != 1) {
    parsed = toml::parse("value = ''", name);
    parsed.get("value")->as_string()->get() = text;
  }
  toml::node& value = *parsed.get("value");
  const toml::source_region region = value.source();
  toml::table table;
  table.insert_or_assign(toml::key(key, region), std::move(value));
  return table;
}

std::string place(const toml::source_region& region) {
  if (!region.path) return "config";
  if (is_override(region) || region.begin.line == 0) return *region.path;
  return fmt::format("{}:{}:{}", *region.path, region.begin.line, region.begin.column);
}

void check_keys(const toml::table& table, const std::vector<std::string>& known) {
  for (const auto& [key, node] : table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string guess = closest_word(key.str(), known);
    fail(key.source(), "unknown key '{}'{}", key.str(),
         guess.empty() ? fmt::format(" (allowed are {})", fmt::join(known, ", "))
                       : fmt::format(" (did you mean '{}'?)", guess));
  }
}

const toml::source_region& key_region(const toml::table& table, std::string_view key) {
  const auto found = table.find(key);
  return found == table.end() ? table.source() : found->first.source();
}

std::size_t index_of_word(const std::string& word, const std::vector<std::string>& words,
                          std::string_view key, const toml::source_region& region) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::string guess = closest_word(word, words);
  fail(region, "unknown {} '{}' ({})", key, word,
       guess.empty() ? fmt::format("allowed are {}", fmt::join(words, ", "))
                     : fmt::format("did you mean '{}'?", guess));
}

namespace detail {

void wrong_type(const toml::node& node, const Slot& slot, const std::string& allowed) {
  fail(slot.region, "'{}' is {}, allowed is {}", slot.key, type_name(node), allowed);
}

std::int64_t read_integer(const toml::node& node, const Slot& slot, const std::string& allowed) {
  if (!node.is_integer()) wrong_type(node, slot, allowed);
  const std::int64_t value = *node.value<std::int64_t>();
  const auto number = static_cast<double>(value);
  if (!slot.range.contains(number)) out_of_range(value, slot);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    fail(slot.region, "'{}' = {} is too large", slot.key, value);
  return value;
}

double read_number(const toml::node& node, const Slot& slot, const std::string& allowed) {
  if (!node.is_integer() && !node.is_floating_point()) wrong_type(node, slot, allowed);
  const double value = *node.value<double>();
  if (!slot.range.contains(value)) out_of_range(value, slot);
  return value;
}

std::string read_string(const toml::node& node, const Slot& slot, const std::string& allowed) {
  if (!node.is_string()) wrong_type(node, slot, allowed);
  std::string text = node.as_string()->get();
  if (text.find('\0') != std::string::npos)
    fail(slot.region, "'{}' contains a zero character", slot.key);
  return text;
}

fs::path read_path(const toml::node& node, const Slot& slot, const std::string& allowed) {
  const fs::path path = read_string(node, slot, allowed);
  if (path.empty()) return path;  // no file is wanted
  const fs::path file = (folder_of(slot.region) / path).lexically_normal();
  if (picture_in_memory(file)) return file;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) fail(slot.region, "there is no file {}", file.string());
  if (!fs::is_regular_file(file, ignored)) fail(slot.region, "{} is not a file", file.string());
  return file;
}

FileOrName read_file_or_name(const toml::node& node, const Slot& slot, const std::string& allowed) {
  const FileOrName word = read_string(node, slot, allowed);
  if (word.is_name()) return word;
  const FileOrName file = read_path(node, slot, allowed);
  return file.is_name() ? FileOrName(fs::path(".") / file) : file;  // "./photo" stays a file
}

}  // namespace detail

std::string required_text(const toml::table& table, std::string_view key) {
  const toml::node* node = table.get(key);
  if (!node) fail(table.source(), "key '{}' is missing", key);
  const detail::Slot slot{key, {}, key_region(table, key)};
  std::string text = detail::read_string(*node, slot, "a text");
  if (text.empty()) fail(slot.region, "'{}' is empty", key);
  return text;
}

fs::path read_file_or_folder(const toml::node& node, std::string_view key,
                             const std::string& allowed) {
  const detail::Slot slot{key, {}, node.source()};
  const fs::path path = detail::read_string(node, slot, allowed);
  const fs::path folder = (folder_of(slot.region) / path).lexically_normal();
  std::error_code ignored;
  if (!path.empty() && fs::is_directory(folder, ignored)) return folder;
  const fs::path file = detail::read_path(node, slot, allowed);
  if (file.empty()) fail(slot.region, "'{}' has an empty name", key);
  return file;
}

fs::path required_folder(const toml::table& table, std::string_view key) {
  const std::string text = required_text(table, key);
  const toml::source_region& region = key_region(table, key);
  const fs::path folder = (folder_of(region) / text).lexically_normal();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) fail(region, "there is no folder {}", folder.string());
  return folder;
}

}  // namespace gramloom
