#pragma once

#include <string>
#include <vector>

#include "jobs/baseline.h"
#include "runs/comparison.h"

namespace gramloom {

/// What differs between two runs by more than `limits`, job by job:
/// - a job that is gone, or no longer done, is worse; a new one has changed; one that is done now,
///   better;
/// - settings have changed; then other pixels have changed, too, and are no longer called worse;
/// - pictures of another size or number of channels, with more than `pixel_share` of their pixels
///   over `pixel_tolerance`, or any over `pixel_limit`, are worse;
/// - scores are judged by their distance d from the best value (metrics()): by how much it has
///   grown, (now − before) / max(before, score_floor), against `score_change`. One that has
///   fallen by as much is better. A score that is gone is worse where scoring failed.
/// Throws Error for a picture that cannot be read.
std::vector<Change> compare(const Baseline& before, const Baseline& now,
                            const BaselineLimits& limits);

/// How many of the changes are for the worse.
std::size_t count_worse(const std::vector<Change>& changes);

/// A row a change, the worse ones first, and a line that counts them.
std::string change_table(const std::vector<Change>& changes, const Baseline& before,
                         const Baseline& now);

/// The jobs done in both runs whose pictures have other bytes, or whose scores are others.
std::vector<ChangedJob> changed_jobs(const Baseline& before, const Baseline& now);

/// What baseline.json says of all that.
ComparisonRecord comparison_record(const std::vector<Change>& changes, const Baseline& before,
                                   const Baseline& now, const BaselineLimits& limits);

}  // namespace gramloom
