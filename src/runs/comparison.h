#pragma once

#include <string>
#include <vector>

#include "io/json_fields.h"
#include "runs/baseline_limits.h"

namespace gramloom {

enum class Verdict { worse, better, changed };
template <>
inline constexpr auto enum_names<Verdict> = std::to_array<std::string_view>({"worse", "better",
                                                                             "changed"});

/// One thing that is not as it was.
struct Change {
  Verdict verdict = Verdict::changed;
  std::string job;  // or exemplar/method, of the diversity
  std::string what;
  std::string before;
  std::string now;

  static constexpr auto fields() {
    using C = Change;
    return std::tuple{
        Field{"verdict", &C::verdict, "whether it is for the worse"},
        Field{"job", &C::job, "its name"},
        Field{"what", &C::what, "what is not as it was"},
        Field{"before", &C::before, "in the earlier run"},
        Field{"now", &C::now, "in this one"},
    };
  }
};

/// The content of baseline.json: how a run differs from an earlier one.
struct ComparisonRecord {
  static constexpr int version = 2;
  static constexpr std::string_view what = "the baseline.json of a run";

  std::string baseline;  // the earlier run's folder
  BaselineLimits limits;
  int worse = 0;
  std::vector<Change> changes;

  static constexpr auto fields() {
    using C = ComparisonRecord;
    return std::tuple{
        Field{"baseline", &C::baseline, "folder of the earlier run"},
        Field{"limits", &C::limits, "the config's [baseline]"},
        Field{"worse", &C::worse, "how many changes are for the worse", "", {0, 1e9}},
        Field{"changes", &C::changes, "what differs"},
    };
  }
};

}  // namespace gramloom
