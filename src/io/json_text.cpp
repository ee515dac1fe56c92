#include "io/json_text.h"

#include "io/text_file.h"

namespace gramloom {

namespace {

constexpr int deepest_list = 100;

}  // namespace

void check_nesting(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_list)
        throw Error("lists in lists, nested deeper than {}", deepest_list);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

std::string message_of(const std::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.starts_with("[json.") ? text.find("] ") : std::string::npos;
  return first_line(end == std::string::npos ? text : text.substr(end + 2));
}

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return parse_json(text);
  } catch (const Error& error) {
    throw Error("{}: not JSON: {}", path.string(), error.what());
  }
}

std::string valid_utf8(const std::string& text) {
  return Json::parse(to_text(Json(text))).get<std::string>();
}

}  // namespace gramloom
