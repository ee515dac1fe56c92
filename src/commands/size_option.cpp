#include "commands/size_option.h"

#include <charconv>

#include "core/error.h"

namespace gramloom {

Size size_of(std::string_view option, const std::string& text, int longest) {
  const auto cross = text.find_first_of("xX,");
  const auto number = [&](std::string_view word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < 1 || value > longest)
      throw ConfigError("{} {}: needed is {}, each from 1 to {} pixels", option, text,
                        size_notation, longest);
    return value;
  };
  const std::string_view words(text);
  if (cross == std::string::npos) return {number(words), number(words)};
  return {number(words.substr(0, cross)), number(words.substr(cross + 1))};
}

}  // namespace gramloom
