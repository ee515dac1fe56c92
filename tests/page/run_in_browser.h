#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/image.h"
#include "page/chromium.h"

namespace gramloom {

// Words of all tests of pages.
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

inline constexpr Size desk{1280, 900};
// Laid out as a desk: for what is drawn by software, where each pixel takes its time.
inline constexpr Size small_desk{880, 600};
inline constexpr Size phone{390, 844};

/// Tests of the pages of runs: one folder and one browser for all tests of a suite, which are
/// skipped where there is no Chromium. A suite's SetUpTestSuite() makes the folder, runs what the
/// pages are of, and then starts the browser.
class RunInBrowser : public testing::Test {
 protected:
  // False where there is no Chromium.
  static bool make_folder(const std::string& name) {
    if (!Chromium::find()) return false;
    folder_ = fs::temp_directory_path() / fmt::format("{}_{}", name, getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    return true;
  }
  static void start_browser() { browser_ = std::make_unique<Chromium>(*Chromium::find()); }
  static void TearDownTestSuite() {
    browser_.reset();
    if (!folder_.empty()) fs::remove_all(folder_);
    folder_.clear();
  }
  void SetUp() override {
    if (!browser_) GTEST_SKIP() << "no Chromium on this machine (Debian: apt install chromium)";
  }

  static nlohmann::json js(const std::string& expression) { return browser_->evaluate(expression); }
  static std::string text(const std::string& selector) {
    return js("((e) => e.innerText ?? e.textContent)(document.querySelector(`" + selector + "`))");
  }
  static void click(const std::string& selector) {
    js("document.querySelector(`" + selector + "`).click()");
  }
  static void wait() { js("new Promise((done) => setTimeout(done, 100))"); }
  // Loads every picture, and counts those that show nothing.
  static int pictures_missing() {
    return js(
        "Promise.all([...document.images].map((image) => { image.loading = 'eager';"
        "  return image.decode().then(() => 0, () => 1); }))"
        ".then((failed) => failed.reduce((a, b) => a + b, 0))");
  }
  // Opens the picture of a job.
  static void enlarge(const std::string& job) {
    js("[...document.querySelectorAll('#rows button')].find((b) => b.dataset.id === " +
       nlohmann::json(job).dump() + ").click()");
  }
  // A picture to look at, where the environment says where to.
  static void keep(const std::string& name) {
    if (const char* where = std::getenv("GRAMLOOM_SCREENSHOTS"))
      browser_->screenshot(fs::path(where) / (name + ".png"));
  }

  inline static fs::path folder_;
  inline static std::unique_ptr<Chromium> browser_;
};

}  // namespace gramloom
