#include "jobs/baseline.h"

#include <algorithm>

#include "io/image_file.h"
#include "io/text_file.h"
#include "jobs/plan.h"
#include "jobs/run_file.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// The names of the jobs that a run.json says were begun.
std::vector<std::string> begun_jobs(const fs::path& run_json) {
  const std::string text = read_text(run_json);
  std::vector<std::string> names;
  try {
    const Json run = Json::parse(text);
    for (const auto& [name, state] : run.at("jobs").items())
      if (state.at("status") != "waiting") names.push_back(name);
  } catch (const Json::exception&) {
    throw Error("{}: not the run.json of a run", run_json.string());
  }
  return names;
}

}  // namespace

Baseline read_baseline(const fs::path& folder, const std::string& only) {
  const fs::path run_json = folder / "run.json";
  Baseline baseline{folder, {}, {}};
  for (const std::string& name : begun_jobs(run_json)) {
    if (!job_matches(only, name)) continue;
    const fs::path file = job_files(folder, name).record;
    auto record = read_record(file);
    if (!record) throw Error("{}: missing, or not the record of a job", file.string());
    baseline.jobs.emplace(name, std::move(*record));
  }
  for (const SeedDiversity& of : read_diversity(run_json))
    if (std::any_of(baseline.jobs.begin(), baseline.jobs.end(), [&](const auto& job) {
          return job.second.exemplar == of.exemplar && job.second.method == of.method;
        }))
      baseline.diversity.push_back(of);
  return baseline;
}

void check_pictures(const Baseline& baseline) {
  for (const auto& [name, record] : baseline.jobs)
    if (record.status == Status::done)
      for (const auto& file : record.files)
        read_image(job_files(baseline.folder, name).folder / file);
}

}  // namespace gramloom
