// The layers of the house: which folder of src may include which. Data flows one way.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "source_folder.h"

namespace {

namespace fs = std::filesystem;

const fs::path source = source_folder() / "src";

const std::map<std::string, std::set<std::string>> may_include{
    {"core", {}},
    {"io", {"core"}},
    {"procedural", {"core"}},
    {"signal", {"core"}},
    {"classic", {"core", "signal"}},
    {"surface", {"core", "signal"}},
    {"neural", {"core", "signal", "io"}},
    {"metrics", {"core", "signal", "classic"}},
    {"runs", {"core", "io"}},
    {"report", {"core", "signal", "io", "metrics", "runs"}},
    {"jobs",
     {"core", "signal", "io", "procedural", "classic", "neural", "surface", "metrics", "runs"}},
};

TEST(Layers, EachFolderIncludesOnlyWhatLiesBelowIt) {
  const std::regex include(R"re(^\s*#include\s+"([a-z_]+)/[^"]*")re");
  int seen = 0;
  for (const auto& [folder, allowed] : may_include) {
    if (!fs::is_directory(source / folder)) continue;
    for (const auto& file : fs::recursive_directory_iterator(source / folder)) {
      std::ifstream text(file.path());
      std::smatch match;
      for (std::string line; std::getline(text, line);)
        if (std::regex_search(line, match, include)) {
          ++seen;
          EXPECT_TRUE(match[1] == folder || allowed.contains(match[1]))
              << file.path() << " includes " << match[1];
        }
    }
  }
  EXPECT_GT(seen, 5);
}

TEST(Layers, PublicHeadersHideTorch) {
  for (const auto& file : fs::recursive_directory_iterator(source)) {
    const auto name = file.path().filename().string();
    const auto folder = fs::relative(file.path(), source).begin()->string();
    if (file.path().extension() != ".h" || folder == "neural") continue;
    std::ifstream text(file.path());
    for (std::string line; std::getline(text, line);) {
      EXPECT_EQ(line.find("#include <torch"), std::string::npos) << file.path();
      EXPECT_EQ(line.find("#include <ATen"), std::string::npos) << file.path();
    }
  }
}

}  // namespace
