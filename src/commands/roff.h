#pragma once

#include <string>
#include <string_view>

namespace gramloom {

/// A manual page as man(7) has it, built from top to bottom.
class Roff {
 public:
  Roff(std::string_view name, int section, std::string_view version);

  void heading(std::string_view text);
  void subheading(std::string_view text);
  void paragraph(std::string_view text);
  /// A line as it is, such as an example.
  void verbatim(std::string_view lines);
  /// A term in bold, what follows it on its line in italics, and under it the text.
  void entry(std::string_view term, std::string_view follows, std::string_view text);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace gramloom
