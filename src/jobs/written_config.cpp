#include "jobs/written_config.h"

#include "io/json_text.h"
#include "jobs/exemplar_entries.h"
#include "jobs/input_files.h"
#include "jobs/protected_files.h"

namespace gramloom {

namespace fs = std::filesystem;

// TOML's basic strings are JSON's.
std::string quoted(const std::string& text) {
  if (valid_utf8(text) != text)
    throw ConfigError("the name {} is not UTF-8, as a config must be: rename the file",
                      valid_utf8(text));
  return Json(text).dump();
}

std::string quoted_path(const fs::path& file) {
  return quoted(fs::absolute(file).lexically_normal().string());
}

std::string quoted_paths(const std::vector<fs::path>& files) {
  std::string list;
  for (const fs::path& file : files) list += (list.empty() ? "" : ", ") + quoted_path(file);
  return "[" + list + "]";
}

std::string named_files_in_config(const NamedFiles<MapFile>& files) {
  std::string table;
  for (const auto& [name, file] : files) {
    std::string entry;
    for_each_value(file, [&](const FieldText& field, const auto& value) {
      if (const std::string text = value_in_config(value); !text.empty())
        entry += fmt::format("{}{} = {}", entry.empty() ? "" : ", ", field.name, text);
    });
    table += fmt::format("{}{} = {}", table.empty() ? "" : ", ", quoted(name),
                         file.kind || file.green ? "{ " + entry + " }" : quoted_path(file.image));
  }
  return "{ " + table + " }";
}

std::string exemplar_name(const fs::path& picture) {
  const std::string name = picture.stem().string();
  try {
    check_exemplar_name(name, {});
    return name;
  } catch (const ConfigError&) {
    return "picture";
  }
}

namespace {

// Without "make:8:1: " before it.
std::string without_place(const std::string& message, const std::string& file) {
  const std::string digits = "0123456789";
  if (!message.starts_with(file + ":")) return message;
  std::size_t end = message.find_first_not_of(digits, file.size() + 1);
  if (end == std::string::npos || message[end] != ':') return message;
  end = message.find_first_not_of(digits, end + 1);
  if (end == std::string::npos || !message.substr(end).starts_with(": ")) return message;
  return message.substr(end + 2);
}

template <class T>
std::string text_of_parameter(const T& value) {
  const std::string text = value_in_config(value);
  return text.empty() ? value_to_text(value) : text;
}

}  // namespace

Config parse_unseen_config(const std::string& text, const fs::path& file) {
  try {
    return parse_config(text, file);
  } catch (const ConfigError& error) {
    throw ConfigError("{}", without_place(error.what(), file.string()));
  }
}

std::string parameter_text(const Method& method, std::string_view key) {
  std::string text;
  std::visit(
      [&](const auto& params) {
        for_each_parameter(params, [&](const FieldText& field, const auto& value) {
          if (field.name == key) text = text_of_parameter(value);
        });
      },
      method);
  return text;
}

void check_result(const fs::path& output, const Config& config, const std::string& mark) {
  check_folder_of(output);
  check_replaced(output, ProtectedFiles(input_files(config)), mark);
}

Texture finished_texture(const Method& method, const Request& request, const Control& control) {
  bool stopped = false;
  Control own = control;
  own.progress = [&](const Progress& progress) {
    stopped = !control.report(progress);
    return !stopped;
  };
  Texture texture = run_method(method, request, own);
  if (stopped) throw Interrupted();
  return texture;
}

}  // namespace gramloom
