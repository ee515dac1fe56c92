#include "runs/record.h"

#include <algorithm>

#include "io/text_file.h"

namespace gramloom {

namespace fs = std::filesystem;

std::optional<LossSummary> summarise(const Trace& trace) {
  if (trace.rows.empty()) return std::nullopt;
  const TraceRow& last = trace.rows.back();
  return LossSummary{last.step, last.evaluations, trace.rows.front().loss, last.loss};
}

Json record_to_json(const JobRecord& record) {
  Json json{{"exemplar", record.exemplar},
            {"method", record.method},
            {"kind", record.kind},
            {"seed", record.seed},
            {"width", record.size.width},
            {"height", record.size.height},
            {"status", to_word(record.status)},
            {"error", record.error},
            {"seconds", record.seconds},
            {"peak_memory_mb", record.peak_memory_mb},
            {"settings", record.settings},
            {"metrics", record.metrics},
            {"files", record.files}};
  if (!record.copy_map.empty()) json["copy_map"] = record.copy_map;
  if (record.score_seconds > 0) json["score_seconds"] = record.score_seconds;
  if (!record.score_error.empty()) json["score_error"] = record.score_error;
  if (record.loss) {
    json["iterations"] = record.loss->iterations;
    json["evaluations"] = record.loss->evaluations;
    json["loss_first"] = record.loss->first;
    json["loss_last"] = record.loss->last;
  }
  return json;
}

void write_record(const fs::path& file, const JobRecord& record) {
  // A path may hold bytes that are not UTF-8: better a replaced letter than no record.
  write_text(file,
             record_to_json(record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::optional<JobRecord> read_record(const fs::path& file) {
  try {
    const Json json = Json::parse(read_text(file));
    const auto words = enum_names<Status>;
    const auto status = std::find(words.begin(), words.end(), json.at("status").get<std::string>());
    if (status == words.end()) return std::nullopt;
    JobRecord record{json.at("exemplar"),
                     json.at("method"),
                     json.at("kind"),
                     json.at("seed"),
                     {json.at("width"), json.at("height")},
                     static_cast<Status>(status - words.begin()),
                     json.at("error"),
                     json.at("seconds"),
                     json.at("peak_memory_mb"),
                     json.at("settings"),
                     json.at("metrics"),
                     std::nullopt,
                     json.at("files"),
                     json.value("copy_map", ""),
                     json.value("score_seconds", 0.0),
                     json.value("score_error", "")};
    if (json.contains("loss_last"))
      record.loss = LossSummary{json.at("iterations"), json.at("evaluations"),
                                json.at("loss_first"), json.at("loss_last")};
    return record;
  } catch (const Error&) {
    return std::nullopt;
  } catch (const Json::exception&) {
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

std::string reason_to_run(const std::optional<JobRecord>& record, const Json& settings,
                          const fs::path& folder) {
  if (!record) return "not done before";
  if (record->status != Status::done) return fmt::format("was {} before", to_word(record->status));
  if (!is_finished(record, folder)) return "its picture is gone";
  const Json changes = Json::diff(record->settings, settings);
  if (changes.empty()) return "";
  return fmt::format("{} changed since", changes.front().at("path").get<std::string>().substr(1));
}

}  // namespace gramloom
