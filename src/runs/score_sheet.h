#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/record.h"

namespace gramloom {

/// How unlike the results of one exemplar and method with several seeds are.
struct SeedDiversity {
  std::string exemplar;
  std::string method;
  std::vector<int> seeds;
  double value = 0;
};

/// A job of a run and how it stands.
struct JobState {
  std::string name;
  std::string exemplar;  // the folder's name
  std::string method;
  std::string kind;
  int seed = 0;
  std::optional<JobRecord> record;  // none: not begun, "waiting"

  std::string_view status() const { return record ? to_word(record->status) : "waiting"; }
};

/// The table scores.csv: a line for each job, with a column for each of `metrics` by their names. A
/// cell is empty where there is no such number.
std::string score_sheet(const std::vector<JobState>& jobs,
                        const std::vector<SeedDiversity>& diversity,
                        const std::vector<std::string>& metrics);

}  // namespace gramloom
