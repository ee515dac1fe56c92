#include "docs/markdown.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "io/text_file.h"
#include "source_folder.h"

namespace gramloom {

namespace fs = std::filesystem;

namespace {

const std::string fence = "```";

// Lower case, spaces as hyphens, and nothing else but letters, digits, hyphens and underscores.
std::string anchor(const std::string& heading) {
  std::string text;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == ' ') text += '-';
    if (byte >= 0x80 || std::isalnum(byte) || letter == '-' || letter == '_')
      text += static_cast<char>(std::tolower(byte));
  }
  return text;
}

std::vector<Link> matches(const std::string& line, int number, const std::regex& pattern) {
  std::vector<Link> found;
  for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it)
    found.push_back({(*it)[1], number});
  return found;
}

void append(std::vector<Link>& to, const std::vector<Link>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

Page read_page(const fs::path& file) {
  static const std::regex note("<!-- *([a-z ]+): *(.*[^ ]) *-->"), heading("#+ +(.*[^ ]) *"),
      in_code("`([^`]+)`"), link(R"(\]\(([^)]+)\))");
  Page page;
  page.file = file;
  std::map<std::string, int> repeated;
  std::vector<Note> notes;
  std::string closing;  // of the block that we are in
  std::istringstream lines(read_text(file));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    if (!closing.empty()) {
      if (line == closing)
        closing.clear();
      else
        page.blocks.back().text += line + "\n";
    } else if (line.compare(indent, fence.size(), fence) == 0) {
      closing = line.substr(0, indent) + fence;
      page.blocks.push_back({line.substr(indent + fence.size()), "", number, std::move(notes)});
      notes.clear();
    } else if (std::regex_match(line, match, note)) {
      notes.push_back({match[1], match[2]});
    } else {
      notes.clear();
      if (std::regex_match(line, match, heading)) {
        const std::string name = anchor(match[1]);
        const int before = repeated[name]++;
        page.headings.insert(before == 0 ? name : name + "-" + std::to_string(before));
      }
      append(page.code, matches(line, number, in_code));
      append(page.links, matches(std::regex_replace(line, in_code, ""), number, link));
    }
  }
  return page;
}

std::vector<fs::path> markdown_files() {
  std::vector<fs::path> files;
  const auto is_ours = [](const fs::path& folder) {
    const std::string name = folder.filename().string();
    return !name.starts_with(".") && !name.starts_with("build") && name != "out";
  };
  for (auto it = fs::recursive_directory_iterator(source_folder()); it != end(it); ++it) {
    if (it->is_directory() && !is_ours(it->path())) it.disable_recursion_pending();
    if (it->path().extension() == ".md") files.push_back(it->path());
  }
  const fs::path first = source_folder() / "README.md";
  std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
    return a != b && (a == first || (b != first && a < b));
  });
  return files;
}

}  // namespace gramloom
