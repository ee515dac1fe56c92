#include "jobs/baseline.h"

#include <algorithm>

#include "io/image_file.h"
#include "jobs/plan.h"
#include "runs/format.h"
#include "runs/job_files.h"
#include "runs/run_record.h"

namespace gramloom {

namespace fs = std::filesystem;

Baseline read_baseline(const fs::path& folder, const std::string& only) {
  const auto run = read_format<RunRecord>(folder / "run.json");
  Baseline baseline{folder, {}, {}};
  for (const auto& [name, standing] : run.jobs) {
    if (!job_matches(only, name)) continue;
    const fs::path file = job_files(folder, name).record;
    // A killed run may be further than its overview says.
    std::error_code ignored;
    if (standing.status == Status::waiting && !fs::exists(file, ignored)) continue;
    baseline.jobs.emplace(name, read_record(file));
  }
  for (const SeedDiversity& of : run.diversity)
    if (std::any_of(baseline.jobs.begin(), baseline.jobs.end(), [&](const auto& job) {
          return job.second.exemplar == of.exemplar && job.second.method == of.method;
        }))
      baseline.diversity.push_back(of);
  return baseline;
}

void check_baseline(const Baseline& baseline) {
  const auto finished = [](const auto& job) { return job.second.status == Status::done; };
  if (std::none_of(baseline.jobs.begin(), baseline.jobs.end(), finished))
    throw Error("no job of it is finished, so there is nothing to compare with");
  for (const auto& [name, record] : baseline.jobs)
    if (record.status == Status::done)
      for (const auto& file : record.files)
        read_image(job_files(baseline.folder, name).folder / file);
}

}  // namespace gramloom
