#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"

namespace gramloom {

/// A headless Chromium with one page in it, driven through the DevTools protocol over two pipes.
/// Every function throws Error when the browser does not answer.
class Chromium {
 public:
  using Json = nlohmann::json;

  /// The browser on this machine, if there is one.
  static std::optional<std::filesystem::path> find();

  explicit Chromium(const std::filesystem::path& program);
  ~Chromium();
  Chromium(const Chromium&) = delete;
  Chromium& operator=(const Chromium&) = delete;

  /// Opens a file in a window of this size, and waits until it is loaded.
  void open(const std::filesystem::path& file, Size window, bool dark = false);
  /// The value of a JavaScript expression, awaited if it is a promise. A thrown error is an Error.
  Json evaluate(const std::string& expression);
  /// A press of a key as a user's: "ArrowLeft", "Escape", " ", "t".
  void press(const std::string& key);
  /// Errors, warnings and uncaught exceptions on the console, and what could not be loaded.
  std::vector<std::string> problems();
  /// What the window shows, as PNG.
  void screenshot(const std::filesystem::path& file);

 private:
  Json call(const std::string& method, const Json& params = Json::object());
  Json receive();

  std::filesystem::path profile_;
  pid_t pid_ = -1;
  int to_ = -1;
  int from_ = -1;
  int count_ = 0;
  std::string session_;
  std::string unread_;
  std::vector<Json> events_;
};

}  // namespace gramloom
