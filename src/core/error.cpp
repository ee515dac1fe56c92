#include "core/error.h"

namespace gramloom {

std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "\\n";
    else if (c == '\r')
      line += "\\r";
    else if (c == '\t')
      line += "\\t";
    else if ((c >= 0 && c < ' ') || c == '\x7f')
      line += fmt::format("\\x{:02x}", static_cast<int>(c));
    else
      line += c;
  }
  return line;
}

std::string Error::message(fmt::string_view text, fmt::format_args args) {
  return on_one_line(fmt::vformat(text, args));
}

}  // namespace gramloom
