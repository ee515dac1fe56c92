#include "report/page.h"

#include <algorithm>

#include "core/error.h"
#include "io/text_file.h"
#include "report/page_data.h"
#include "report/page_template.h"

namespace gramloom {

namespace {

// JSON inside a script element: without a "<" nothing ends the element or begins a comment.
std::string script_safe(const Json& data) {
  std::string safe;
  for (const char c : to_text(data)) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

// The first of them, and how many there are.
std::vector<std::string> told_of(const Json& trouble) {
  constexpr std::size_t most = 10;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(most, trouble.size()); ++i)
    lines.push_back(first_line(trouble[i].get<std::string>()));
  if (trouble.size() > most)
    lines.push_back(fmt::format("and {} more, which the page names", trouble.size() - most));
  return lines;
}

}  // namespace

std::string page_html(const Json& data) {
  constexpr std::string_view mark = "/*data*/";
  std::string html(page_template);
  return html.replace(html.find(mark), mark.size(), script_safe(data));
}

WrittenPage write_page(const std::filesystem::path& folder) { return write_page(read_run(folder)); }

WrittenPage write_page(const RunOnDisk& run) {
  WrittenPage page{run.folder / "index.html", {}};
  try {
    const Json data = page_data(run);
    write_text(page.file, page_html(data) + "\n");
    page.trouble = told_of(data.at("trouble"));
  } catch (const Json::exception& error) {
    throw Error("{}: holds what no run writes: {}", run.folder.string(), message_of(error));
  }
  return page;
}

}  // namespace gramloom
