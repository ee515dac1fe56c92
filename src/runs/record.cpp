#include "runs/record.h"

#include <algorithm>

#include "runs/format.h"
#include "runs/map_names.h"

namespace gramloom {

namespace fs = std::filesystem;

std::optional<LossSummary> summarise(const Trace& trace) {
  if (trace.rows.empty()) return std::nullopt;
  const TraceRow& last = trace.rows.back();
  return LossSummary{last.step, last.evaluations, trace.rows.front().loss, last.loss};
}

namespace {

Json table_in(const Json& json, const std::string& key) {
  return json.is_object() && json.contains(key) && json.at(key).is_object() ? json.at(key)
                                                                            : Json::object();
}
std::string text_in(const Json& json, const std::string& key) {
  return json.contains(key) && json.at(key).is_string() ? json.at(key).get<std::string>() : "";
}

// The maps of normals of a record that lacks them, by what its settings say of the exemplar's maps
// and of those that were made of a height.
Json normals_of_settings(const Json& settings) {
  Json normals = Json::object();
  const Json surface = table_in(settings, "surface");
  if (surface.value("normal", Json()) == true)
    normals["normal"] = text_in(surface, "green") == "down" ? "down" : "up";
  const Json maps = table_in(table_in(settings, "exemplar"), "maps");
  for (const auto& [map, entry] : maps.items()) {
    const std::string kind = entry.is_object() ? text_in(entry, "kind") : "";
    const std::string green = entry.is_object() ? text_in(entry, "green") : "";
    const std::string stem =
        entry.is_object() ? fs::path(text_in(entry, "image")).stem().string() : "";
    const auto named = kind_of_name(map, 3) ? kind_of_name(map, 3) : kind_of_name(stem, 3);
    const bool is_normal =
        kind.empty() ? named == MapKind::normal || !green.empty() : kind == "normal";
    if (!is_normal) continue;
    const auto by_name = green_of_name(map) ? green_of_name(map) : green_of_name(stem);
    normals[map] = !green.empty() ? green : std::string(to_word(by_name.value_or(GreenAxis::up)));
  }
  return normals;
}

}  // namespace

void JobRecord::upgrade(Json& json, const std::string& file) {
  for (const auto* key : {"exemplar", "method", "seed", "status"}) required_key(json, key, {file});
  if (json.contains("width") && json.contains("height"))
    json["size"] = {json["width"], json["height"]};
  if (json.contains("loss_last"))
    json["loss"] = {{"iterations", required_key(json, "iterations", {file})},
                    {"evaluations", required_key(json, "evaluations", {file})},
                    {"first", required_key(json, "loss_first", {file})},
                    {"last", json["loss_last"]}};
  if (!json.contains("normals") && json.contains("settings"))
    json["normals"] = normals_of_settings(json["settings"]);
}

void write_record(const fs::path& file, const JobRecord& record) { write_format(file, record); }

JobRecord read_record(const fs::path& file) { return read_format<JobRecord>(file); }

std::optional<JobRecord> find_record(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  try {
    return read_record(file);
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool is_finished(const std::optional<JobRecord>& record, const fs::path& folder) {
  return record && record->status == Status::done && !record->files.empty() &&
         std::all_of(record->files.begin(), record->files.end(), [&](const auto& name) {
           std::error_code ignored;
           return fs::is_regular_file(folder / name, ignored);
         });
}

}  // namespace gramloom
