#include "runs/own_files.h"

#include <optional>

#include "core/error.h"
#include "io/json_text.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Nothing for what is no file that can be read.
std::optional<std::string> text_of(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return std::nullopt;
  try {
    return read_text(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<Json> json_of(const fs::path& file) {
  const auto text = text_of(file);
  if (!text) return std::nullopt;
  try {
    Json json = parse_json(*text);
    return json.is_object() ? std::optional(std::move(json)) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

bool is_page(const fs::path& file) {
  const auto text = text_of(file);
  return text && text->find("<meta name=\"generator\" content=\"gramloom\">") != std::string::npos;
}

bool is_score_sheet(const fs::path& file) {
  const auto text = text_of(file);
  return text && text->starts_with("exemplar,method,kind,seed,");
}

bool is_comparison(const fs::path& file) {
  const auto json = json_of(file);
  return json && json->contains("baseline") && json->contains("limits") &&
         json->contains("changes");
}

bool is_diversity(const fs::path& file) {
  const auto json = json_of(file);
  return json && json->contains("seeds") && json->contains("value") && json->contains("textures");
}

EarlierRun earlier_run_in(const fs::path& folder) {
  const auto json = json_of(folder / "run.json");
  if (!json) return {};
  try {
    EarlierRun run{true, json->value("config", ""), {}, {}};
    run.is_ours = json->at("versions").contains("gramloom");
    for (const auto& [name, state] : json->at("jobs").items()) {
      run.folders.insert(name.substr(0, name.find('/')));
      if (state.at("status") != "waiting") run.begun.insert(name);
    }
    return run;
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace gramloom
