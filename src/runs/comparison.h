#pragma once

#include <map>
#include <optional>
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

/// A picture whose file has other bytes than it had: both from the folder of their run on.
struct ChangedPicture {
  std::string before;
  std::string before_hash;  // of the earlier file's content
  std::string now;

  static constexpr auto fields() {
    using C = ChangedPicture;
    return std::tuple{
        Field{"before", &C::before, "the earlier run's file"},
        Field{"before_hash", &C::before_hash, "of its content"},
        Field{"now", &C::now, "this run's file"},
    };
  }
};

/// A job that both runs have done, but not alike, by however little.
struct ChangedJob {
  std::string job;
  std::vector<ChangedPicture> pictures;
  std::map<std::string, std::optional<double>> scores;  // what those were that are others now

  static constexpr auto fields() {
    using C = ChangedJob;
    return std::tuple{
        Field{"job", &C::job, "its name"},
        Field{"pictures", &C::pictures, "those with other bytes"},
        Field{"scores", &C::scores, "what scores were that are others now"},
    };
  }
};

/// The content of baseline.json: how a run differs from an earlier one.
struct ComparisonRecord {
  static constexpr int version = 3;
  static constexpr std::string_view what = "the baseline.json of a run";

  std::string baseline;  // the earlier run's folder
  std::string folder;    // the same from this run's folder on; "" up to version 2
  BaselineLimits limits;
  int worse = 0;
  std::vector<Change> changes;   // beyond the limits
  std::vector<ChangedJob> jobs;  // none up to version 2

  static constexpr auto fields() {
    using C = ComparisonRecord;
    return std::tuple{
        Field{"baseline", &C::baseline, "folder of the earlier run"},
        Field{"folder", &C::folder, "the same, from this run's folder on"},
        Field{"limits", &C::limits, "the config's [baseline]"},
        Field{"worse", &C::worse, "how many changes are for the worse", "", {0, 1e9}},
        Field{"changes", &C::changes, "what differs by more than the limits"},
        Field{"jobs", &C::jobs, "jobs of both runs that differ by however little"},
    };
  }
};

}  // namespace gramloom
