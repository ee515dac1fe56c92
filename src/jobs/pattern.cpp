#include "jobs/pattern.h"

#include <algorithm>

namespace gramloom {

namespace {

bool continues_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

// The bytes of the letter that a text begins with.
std::size_t letter_size(std::string_view text) {
  const auto next = std::find_if_not(text.begin() + 1, text.end(), continues_letter);
  return static_cast<std::size_t>(next - text.begin());
}

}  // namespace

bool matches(std::string_view pattern, std::string_view text) {
  // What is left of both after the last *, which takes one letter more whenever the rest fails.
  std::string_view pattern_again, text_again;
  bool star = false;
  while (!text.empty()) {
    if (pattern.starts_with('*')) {
      pattern.remove_prefix(1);
      pattern_again = pattern;
      text_again = text;
      star = true;
    } else if (pattern.starts_with('?')) {
      pattern.remove_prefix(1);
      text.remove_prefix(letter_size(text));
    } else if (!pattern.empty() && pattern.front() == text.front()) {
      pattern.remove_prefix(1);
      text.remove_prefix(1);
    } else if (star) {
      text_again.remove_prefix(letter_size(text_again));
      pattern = pattern_again;
      text = text_again;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*') == std::string_view::npos;
}

}  // namespace gramloom
