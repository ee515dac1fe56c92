#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace gramloom {

/// A job or command that cannot be done, in one line for the user (exit code 1).
class Error : public std::runtime_error {
 public:
  template <class... Args>
  explicit Error(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
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
