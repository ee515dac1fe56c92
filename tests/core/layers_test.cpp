// The layers of the house: which folder of src may include which. Data flows one way.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

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
    {"surface", {"core", "signal", "io"}},
    {"neural", {"core", "signal", "io"}},
    {"learnt", {"core", "signal", "io"}},
    {"train", {"core", "signal", "io", "neural", "learnt"}},
    {"metrics", {"core", "signal"}},
    {"runs", {"core", "io"}},
    {"report", {"core", "signal", "io", "learnt", "metrics", "runs"}},
    {"jobs",
     {"core", "signal", "io", "procedural", "classic", "neural", "learnt", "train", "surface",
      "metrics", "runs"}},
    {"python", {"core", "signal", "io", "metrics", "runs", "jobs", "report"}},
    {"commands", {"core", "signal", "io", "learnt", "surface", "runs", "jobs", "report"}},
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

// What stands between the brackets or quotes of the #include lines of a file.
std::vector<std::string> includes_of(const fs::path& file) {
  const std::regex include(R"re(^\s*#include\s+["<]([^">]+)[">])re");
  std::vector<std::string> names;
  std::ifstream text(file);
  std::smatch match;
  for (std::string line; std::getline(text, line);)
    if (std::regex_search(line, match, include)) names.push_back(match[1]);
  return names;
}

std::string folder_of(const fs::path& file) { return fs::relative(file, source).begin()->string(); }

// LibTorch and oneDNN stay inside neural/, learnt/ and train/ (signal/onednn.h is for those):
// neither the headers of other folders name them, nor those headers of these that another folder
// includes, nor what these include in turn.
TEST(Layers, PublicHeadersHideTorch) {
  const std::set<std::string> inside{"neural", "learnt", "train"};
  std::vector<std::string> open;  // headers, as they are included
  for (const auto& file : fs::recursive_directory_iterator(source)) {
    if (file.is_directory() || inside.contains(folder_of(file))) continue;
    if (file.path().filename() == "onednn.h") continue;
    if (file.path().extension() == ".h") open.push_back(fs::relative(file, source).string());
    for (const auto& name : includes_of(file))
      if (inside.contains(name.substr(0, name.find('/')))) open.push_back(name);
  }
  std::map<std::string, std::string> seen;  // and who includes it
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::string header = open[i];  // `open` grows
    for (const auto& name : includes_of(source / header)) {
      for (const auto* library : {"torch/", "ATen/", "c10/", "oneapi/", "dnnl"})
        EXPECT_FALSE(name.starts_with(library))
            << header << " includes " << name << ", and is included by " << seen[header];
      if (fs::exists(source / name) && seen.emplace(name, header).second) open.push_back(name);
    }
  }
  EXPECT_TRUE(seen.contains("neural/params.h"));
  EXPECT_TRUE(seen.contains("neural/loss/sliced.h"));
}

}  // namespace
