#include "commands/roff.h"

#include <fmt/format.h>

namespace gramloom {

namespace {

// Letters that roff would take for its own.
std::string escaped(std::string_view text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    line_begins = c == '\n';
  }
  return result;
}

// A list may be longer than a line: it may be broken behind each comma.
std::string breakable(std::string text) {
  for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += 3)
    text.insert(at + 1, "\\:");
  return text;
}

}  // namespace

// Lines are not filled up to the right edge: keys and paths are long, and must not be hyphenated.
Roff::Roff(std::string_view name, int section, std::string_view version)
    : text_(fmt::format(".TH \"{}\" {} \"\" \"gramloom {}\" \"gramloom\"\n.nh\n.ad l\n",
                        escaped(name), section, escaped(version))) {}

void Roff::heading(std::string_view text) { text_ += fmt::format(".SH \"{}\"\n", escaped(text)); }

void Roff::subheading(std::string_view text) {
  text_ += fmt::format(".SS \"{}\"\n", escaped(text));
}

void Roff::paragraph(std::string_view text) { text_ += fmt::format(".PP\n{}\n", escaped(text)); }

void Roff::verbatim(std::string_view lines) {
  text_ += fmt::format(".PP\n.RS 4\n.nf\n{}\n.fi\n.RE\n", escaped(lines));
}

void Roff::entry(std::string_view term, std::string_view follows, std::string_view text) {
  text_ += fmt::format(".TP\n\\fB{}\\fR", escaped(term));
  if (!follows.empty()) text_ += fmt::format(" \\fI{}\\fR", breakable(escaped(follows)));
  text_ += fmt::format("\n{}\n", escaped(text));
}

}  // namespace gramloom
