#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace gramloom {

/// The text with its control characters as they are written in C: \n, \x1b. Names of files and what
/// stands in them may have some, and then a message were two lines, or steered the terminal.
std::string on_one_line(std::string_view text);

/// A job or command that cannot be done, in one line for the user (exit code 1).
class Error : public std::runtime_error {
 public:
  template <class... Args>
  explicit Error(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(message(text, fmt::make_format_args(args...))) {}

 private:
  static std::string message(fmt::string_view text, fmt::format_args args);
};

/// A mistake in a config, a network description or a command line (exit code 2).
/// The text begins with where it is: "configs/a.toml:12:3: …".
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// The user asked to stop, and there is nothing of the unfinished work to keep.
class Interrupted : public Error {
 public:
  Interrupted() : Error("interrupted") {}
};

}  // namespace gramloom
