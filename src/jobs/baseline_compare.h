#pragma once

#include <string>
#include <vector>

#include "jobs/baseline.h"
#include "runs/baseline_limits.h"

namespace gramloom {

enum class Verdict { worse, better, changed };
template <>
inline constexpr auto enum_names<Verdict> = std::to_array<std::string_view>({"worse", "better",
                                                                             "changed"});

/// One thing that is not as it was.
struct Change {
  std::string job;  // or exemplar/method, of the diversity
  std::string what;
  std::string before;
  std::string now;
  Verdict verdict = Verdict::changed;
};

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

/// {"baseline": folder, "limits": {…}, "worse": 1, "changes": [{"job", "what", …}, …]}
std::string change_json(const std::vector<Change>& changes, const Baseline& before,
                        const BaselineLimits& limits);

}  // namespace gramloom
