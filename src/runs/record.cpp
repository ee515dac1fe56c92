#include "runs/record.h"

#include <algorithm>

#include "runs/format.h"

namespace gramloom {

namespace fs = std::filesystem;

std::optional<LossSummary> summarise(const Trace& trace) {
  if (trace.rows.empty()) return std::nullopt;
  const TraceRow& last = trace.rows.back();
  return LossSummary{last.step, last.evaluations, trace.rows.front().loss, last.loss};
}

void JobRecord::upgrade(Json& json, const std::string& file) {
  for (const auto* key : {"exemplar", "method", "seed", "status"}) required_key(json, key, {file});
  if (json.contains("width") && json.contains("height"))
    json["size"] = {json["width"], json["height"]};
  if (json.contains("loss_last"))
    json["loss"] = {{"iterations", required_key(json, "iterations", {file})},
                    {"evaluations", required_key(json, "evaluations", {file})},
                    {"first", required_key(json, "loss_first", {file})},
                    {"last", json["loss_last"]}};
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
