#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/mean_interval.h"
#include "runs/score_sheet.h"

namespace gramloom {

/// A column of a benchmark: a score, or the largest of several (of two seams the worse).
struct BenchmarkColumn {
  std::string name;
  std::vector<std::string> metrics;  // columns of the sheet of scores, or "seconds"
  bool higher_is_better = false;
};

/// A method in a benchmark.
struct BenchmarkRow {
  std::string method;
  int exemplars = 0;                                // that any value is of
  std::vector<std::optional<MeanInterval>> values;  // a column each; none: no job has such a score
};

/// A row for each method that has a value, in their order, of the jobs that are done. Results of
/// one exemplar are alike, whatever the seed: so each value is the mean over exemplars of the means
/// of their seeds, and exemplars alone count for its interval; how seeds differ is part of how
/// exemplars do. With `against`, a method, the other rows are differences from it, exemplar by
/// exemplar, where both have a value: how hard an exemplar is drops out, and the interval is
/// that of the difference. Throws Error when there is no such method.
std::vector<BenchmarkRow> benchmark_rows(const ScoreSheet& sheet,
                                         const std::vector<BenchmarkColumn>& columns,
                                         const std::string& against = "");

}  // namespace gramloom
