#include <algorithm>

#include "jobs/baseline_compare.h"
#include "jobs/inputs.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// The texture and its maps, by their place in the record.
std::vector<ChangedPicture> changed_pictures(const Baseline& before, const Baseline& now,
                                             const std::string& job) {
  const fs::path folder = fs::path(job).parent_path();
  const auto& was = before.jobs.at(job).files;
  const auto& is = now.jobs.at(job).files;
  std::vector<ChangedPicture> changed;
  for (std::size_t i = 0; i < std::min(was.size(), is.size()); ++i) {
    const fs::path old_file = folder / was[i], new_file = folder / is[i];
    const std::string hash = file_hash(before.folder / old_file);
    if (hash != file_hash(now.folder / new_file))
      changed.push_back({old_file.generic_string(), hash, new_file.generic_string()});
  }
  return changed;
}

JobRecord::Values changed_scores(const JobRecord& before, const JobRecord& now) {
  JobRecord::Values changed;
  for (const auto& [name, was] : before.metrics)
    if (const auto is = now.metrics.find(name); is != now.metrics.end() && is->second != was)
      changed.emplace(name, was);
  return changed;
}

}  // namespace

std::vector<ChangedJob> changed_jobs(const Baseline& before, const Baseline& now) {
  std::vector<ChangedJob> changed;
  for (const auto& [job, is] : now.jobs) {
    const auto was = before.jobs.find(job);
    if (was == before.jobs.end() || was->second.status != Status::done || is.status != Status::done)
      continue;
    ChangedJob found{job, changed_pictures(before, now, job), changed_scores(was->second, is)};
    if (!found.pictures.empty() || !found.scores.empty()) changed.push_back(std::move(found));
  }
  return changed;
}

ComparisonRecord comparison_record(const std::vector<Change>& changes, const Baseline& before,
                                   const Baseline& now, const BaselineLimits& limits) {
  const fs::path from = fs::absolute(now.folder);
  return {before.folder.generic_string(),
          fs::proximate(fs::absolute(before.folder), from).generic_string(),
          limits,
          static_cast<int>(count_worse(changes)),
          changes,
          changed_jobs(before, now)};
}

}  // namespace gramloom
