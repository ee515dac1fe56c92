#include "report/page.h"

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

}  // namespace

std::string page_html(const Json& data) {
  constexpr std::string_view mark = "/*data*/";
  std::string html(page_template);
  return html.replace(html.find(mark), mark.size(), script_safe(data));
}

std::filesystem::path write_page(const std::filesystem::path& folder) {
  return write_page(read_run(folder));
}

std::filesystem::path write_page(const RunOnDisk& run) {
  const std::filesystem::path page = run.folder / "index.html";
  try {
    write_text(page, page_html(page_data(run)) + "\n");
  } catch (const Json::exception& error) {
    throw Error("{}: holds what no run writes: {}", run.folder.string(), message_of(error));
  }
  return page;
}

}  // namespace gramloom
