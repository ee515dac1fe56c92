#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/image.h"
#include "runs/json.h"
#include "runs/trace_file.h"

namespace gramloom {

enum class Status { done, failed, interrupted };
template <>
inline constexpr auto enum_names<Status> = std::to_array<std::string_view>({"done", "failed",
                                                                            "interrupted"});

/// How an iterative method's loss went.
struct LossSummary {
  std::int64_t iterations = 0;
  std::int64_t evaluations = 0;
  double first = 0;
  double last = 0;
};
std::optional<LossSummary> summarise(const Trace& trace);

/// What a job left behind: the content of its JSON file, which is written last and so marks that
/// the job's other files are complete.
struct JobRecord {
  std::string exemplar;  // the folder's name
  std::string method;
  std::string kind;
  int seed = 0;
  Size size;
  Status status = Status::interrupted;
  std::string error;
  double seconds = 0;  // over all attempts
  double peak_memory_mb = 0;
  Json settings;
  Json metrics = Json::object();  // by metrics()' names, null where undefined; empty: not scored
  std::optional<LossSummary> loss;
  std::vector<std::string> files;  // pictures, beside the JSON file; the texture is the first
  std::string copy_map;  // picture of where pixels came from, relative to the run's folder; or ""
  double score_seconds = 0;  // apart from `seconds`
  std::string score_error;   // why a finished texture has no scores; "" where nothing went wrong
};

Json record_to_json(const JobRecord& record);

/// Writes the record; throws Error.
void write_record(const std::filesystem::path& file, const JobRecord& record);
/// None when there is no such file or it is not a record.
std::optional<JobRecord> read_record(const std::filesystem::path& file);

/// Whether `record` is of a finished job whose pictures are still in `folder`.
bool is_finished(const std::optional<JobRecord>& record, const std::filesystem::path& folder);

/// Why --resume has to do a job with these settings (again); "" when it is finished.
std::string reason_to_run(const std::optional<JobRecord>& record, const Json& settings,
                          const std::filesystem::path& folder);

}  // namespace gramloom
