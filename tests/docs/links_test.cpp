// Links and pictures of the documents lead somewhere, and every page can be found.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "docs/markdown.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

std::string place(const Page& page, int line) {
  return fs::relative(page.file, source_folder()).string() + ":" + std::to_string(line);
}

bool leads_away(const std::string& target) {
  return target.find("://") != std::string::npos || target.starts_with("mailto:");
}

// The file that a link of a page names; the page itself, if it names a heading alone.
fs::path file_of(const Page& page, const std::string& target) {
  const std::string name = target.substr(0, target.find('#'));
  return name.empty() ? page.file : (page.file.parent_path() / name).lexically_normal();
}

TEST(Documents, LinksAndPicturesLeadSomewhere) {
  int links = 0, anchors = 0;
  for (const fs::path& file : markdown_files()) {
    const Page page = read_page(file);
    for (const Link& link : page.links) {
      if (leads_away(link.target)) continue;
      ++links;
      const fs::path target = file_of(page, link.target);
      EXPECT_TRUE(fs::exists(target)) << place(page, link.line) << ": there is no " << link.target;
      const std::size_t hash = link.target.find('#');
      if (hash == std::string::npos || !fs::exists(target)) continue;
      ++anchors;
      EXPECT_TRUE(read_page(target).headings.contains(link.target.substr(hash + 1)))
          << place(page, link.line) << ": no heading makes the anchor of " << link.target;
    }
  }
  EXPECT_GT(links, 50);
  EXPECT_GT(anchors, 5);
}

TEST(Documents, EveryPageCanBeReachedFromTheReadme) {
  std::vector<fs::path> reached{source_folder() / "README.md"};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const Page page = read_page(reached[next]);
    for (const Link& link : page.links) {
      const fs::path target = file_of(page, link.target);
      if (target.extension() == ".md" && fs::exists(target) &&
          std::find(reached.begin(), reached.end(), target) == reached.end())
        reached.push_back(target);
    }
  }
  for (const fs::path& file : markdown_files())
    EXPECT_THAT(reached, testing::Contains(file)) << "no page leads to it";
}

// `src/core/image.h` in the text: files and folders of ours are there, by these names.
TEST(Documents, FilesThatAreNamedAreThere) {
  const std::vector<std::string> folders{"configs/", "data/",    "docs/", "examples/",
                                         "models/",  "package/", "src/",  "tests/"};
  int names = 0;
  for (const fs::path& file : markdown_files()) {
    const Page page = read_page(file);
    for (const Link& code : page.code) {
      const std::string name = code.target.substr(0, code.target.find(' '));
      const auto is_in = [&](const std::string& folder) { return name.starts_with(folder); };
      if (std::none_of(folders.begin(), folders.end(), is_in)) continue;
      if (name.find_first_of("*<…{") != std::string::npos) continue;
      ++names;
      EXPECT_TRUE(fs::exists(source_folder() / name))
          << place(page, code.line) << ": there is no " << name;
    }
  }
  EXPECT_GT(names, 30);
}

TEST(Documents, EveryPictureIsShown) {
  std::vector<fs::path> shown;
  for (const fs::path& file : markdown_files()) {
    const Page page = read_page(file);
    for (const Link& link : page.links) shown.push_back(file_of(page, link.target));
  }
  for (const auto& picture : fs::directory_iterator(source_folder() / "data/readme"))
    EXPECT_THAT(shown, testing::Contains(picture.path()));
}

}  // namespace
}  // namespace gramloom
