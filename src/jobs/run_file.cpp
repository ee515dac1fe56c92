#include "jobs/run_file.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>

#include "io/text_file.h"
#include "jobs/machine.h"
#include "metrics/scores.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

Json state_to_json(const JobState& job) {
  Json state{{"status", job.status()}};
  if (!job.record) return state;
  state["seconds"] = job.record->seconds;
  if (!job.record->error.empty()) state["error"] = job.record->error;
  return state;
}

Json diversity_to_json(const std::vector<SeedDiversity>& diversity) {
  Json list = Json::array();
  for (const auto& of : diversity)
    list.push_back({{"exemplar", of.exemplar},
                    {"method", of.method},
                    {"seeds", of.seeds},
                    {"value", of.value}});
  return list;
}

// Of the same exemplar and method: a SeedDiversity or a JobState.
bool is_of(const SeedDiversity& diversity, const auto& other) {
  return diversity.exemplar == other.exemplar && diversity.method == other.method;
}

// "2026-11-22T08:15:00Z"
std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

JobState job_state(const Config& config, const PlannedJob& planned, const fs::path& output) {
  const MethodEntry& method = config.methods[planned.job.method];
  return {planned.name,     exemplar_name(config, planned.job),
          method.name,      std::string(kind_of(method.method)),
          planned.job.seed, read_record(job_files(output, planned.name).record)};
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const Metric& metric : metrics()) names.emplace_back(metric.name);
  return names;
}

}  // namespace

std::vector<SeedDiversity> read_diversity(const fs::path& run_json) {
  std::vector<SeedDiversity> list;
  try {
    const Json json = Json::parse(read_text(run_json));
    for (const Json& of : json.at("diversity"))
      list.push_back({of.at("exemplar"), of.at("method"), of.at("seeds"), of.at("value")});
  } catch (const Error&) {
    // No earlier run.
  } catch (const Json::exception&) {
    // Not one of ours, or older than this table.
  }
  return list;
}

RunFile::RunFile(const Config& config, const Plan& plan, const RunOptions& options)
    : folder_(options.output) {
  const fs::path& output = options.output;
  head_ = {{"date", now()},
           {"command", options.command},
           {"versions", versions_to_json()},
           {"machine", machine_to_json()},
           {"config", config.file.string()},
           {"config_text", config.text},
           {"set", config.overrides},
           {"settings", config_to_json(config)}};
  for (const auto& planned : plan.jobs) jobs_.push_back(job_state(config, planned, output));
  for (const auto& of : read_diversity(output / "run.json"))
    if (std::any_of(jobs_.begin(), jobs_.end(), [&](const auto& job) { return is_of(of, job); }))
      diversity_.push_back(of);
  write();
}

void RunFile::set(const std::string& name, const JobRecord& record) {
  for (JobState& job : jobs_)
    if (job.name == name) job.record = record;
  write();
}

bool RunFile::knows(const SeedDiversity& diversity) const {
  return std::any_of(diversity_.begin(), diversity_.end(), [&](const auto& of) {
    return is_of(of, diversity) && of.seeds == diversity.seeds;
  });
}

void RunFile::set(const SeedDiversity& diversity) {
  std::erase_if(diversity_, [&](const auto& of) { return is_of(of, diversity); });
  diversity_.push_back(diversity);
  write();
}

void RunFile::forget_diversity(const std::string& exemplar, const std::string& method) {
  const auto gone = std::erase_if(
      diversity_, [&](const auto& of) { return of.exemplar == exemplar && of.method == method; });
  if (gone > 0) write();
}

void RunFile::write() const {
  Json content = head_;
  content["jobs"] = Json::object();
  for (const JobState& job : jobs_) content["jobs"][job.name] = state_to_json(job);
  content["diversity"] = diversity_to_json(diversity_);
  write_text(folder_ / "run.json",
             content.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  write_text(folder_ / "scores.csv", score_sheet(jobs_, diversity_, metric_names()));
}

}  // namespace gramloom
