#include "jobs/run_log.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>

#include "jobs/machine.h"
#include "jobs/settings.h"
#include "metrics/scores.h"
#include "runs/format.h"
#include "runs/job_files.h"
#include "runs/score_sheet.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds between_writes{1};
constexpr int pauses = 50;  // between two times of writing, at least, in such times

// "2026-11-22T08:15:00Z"
std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

// The record of a job on disk, or one that says that it is waiting.
JobRecord record_of(const Config& config, const PlannedJob& planned, const fs::path& output) {
  if (auto record = find_record(job_files(output, planned.name).record)) return *record;
  const MethodEntry& method = config.methods[planned.job.method];
  JobRecord record;
  record.exemplar = exemplar_name(config, planned.job);
  record.method = method.name;
  record.kind = kind_of(method.method);
  record.seed = planned.job.seed;
  record.status = Status::waiting;
  return record;
}

// Those that an earlier run knew; none where its file is damaged or not ours.
std::vector<SeedDiversity> earlier_diversity(const fs::path& run_json) {
  try {
    return read_format<RunRecord>(run_json).diversity;
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const Metric& metric : metrics()) names.emplace_back(metric.name);
  return names;
}

void write_run_files(const fs::path& folder, RunRecord run, const std::vector<NamedRecord>& jobs,
                     const std::vector<SeedDiversity>& diversity) {
  run.jobs.clear();
  for (const auto& [name, record] : jobs) run.jobs.emplace_back(name, standing_of(record));
  run.diversity = valid_diversity(diversity, jobs);
  write_format(folder / "run.json", run);
  write_text(folder / "scores.csv", to_csv(score_sheet(jobs, run.diversity, metric_names())));
}

bool is_of(const SeedDiversity& a, const SeedDiversity& b) {
  return a.exemplar == b.exemplar && a.method == b.method;
}

}  // namespace

RunLog::RunLog(const Config& config, const Plan& plan, const RunOptions& options, bool begins)
    : folder_(options.output), shared_(options.shard.has_value()) {
  run_.date = now();
  run_.command = options.command;
  run_.versions = versions();
  run_.machine = machine();
  run_.config = config.file.string();
  run_.config_text = config.text;
  run_.set = config.overrides;
  run_.settings = config_to_json(config);
  for (const auto& planned : plan.jobs) {
    index_[planned.name] = jobs_.size();
    jobs_.push_back({planned.name, record_of(config, planned, folder_)});
  }
  run_.diversity = find_diversity(folder_, jobs_, earlier_diversity(folder_ / "run.json"));
  if (begins) {
    write();
  } else if (const auto other = read_format<RunRecord>(folder_ / "run.json");
             other.settings != run_.settings) {
    throw Error("another config, or with other --set, is run there by others: {}", other.config);
  }
}

RunLog::~RunLog() {
  try {
    finish();
  } catch (const std::exception&) {
    // Whoever wants to hear of it calls finish().
  }
}

void RunLog::set(const std::string& name, const JobRecord& record) {
  jobs_[index_.at(name)].record = record;
  if (shared_) own_.insert(name);
  behind_ = true;
}

bool RunLog::knows(const SeedDiversity& diversity) const {
  return std::any_of(run_.diversity.begin(), run_.diversity.end(), [&](const auto& of) {
    return is_of(of, diversity) && of.seeds == diversity.seeds && of.textures == diversity.textures;
  });
}

void RunLog::set(const SeedDiversity& diversity) {
  std::erase_if(run_.diversity, [&](const auto& of) { return is_of(of, diversity); });
  run_.diversity.push_back(diversity);
  behind_ = true;
}

void RunLog::keep_up() {
  const auto pause =
      std::max<std::chrono::steady_clock::duration>(between_writes, pauses * writing_);
  if (!shared_ && behind_ && std::chrono::steady_clock::now() - written_ >= pause) write();
}

void RunLog::finish() {
  if (!behind_) return;
  if (shared_) read_jobs_of_others();
  write();
}

void RunLog::read_jobs_of_others() {
  for (NamedRecord& job : jobs_)
    if (!own_.contains(job.name))
      if (auto record = find_record(job_files(folder_, job.name).record))
        job.record = std::move(*record);
  run_.diversity = find_diversity(folder_, jobs_, run_.diversity);
}

void RunLog::write() {
  // Also after a failure: a full disk is not asked again at each step of a job.
  written_ = std::chrono::steady_clock::now();
  write_run_files(folder_, run_, jobs_, run_.diversity);
  writing_ = std::chrono::steady_clock::now() - written_;
  behind_ = false;
  ++writes_;
}

void rewrite_run_files(const RunOnDisk& run) {
  std::vector<NamedRecord> jobs;
  for (const JobOnDisk& job : run.jobs) jobs.push_back({job.name, job.record});
  write_run_files(run.folder, run.run, jobs, run.diversity);
}

}  // namespace gramloom
