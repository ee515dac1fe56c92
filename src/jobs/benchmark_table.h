#pragma once

#include <string>
#include <vector>

#include "jobs/peers.h"
#include "runs/benchmark.h"

namespace gramloom {

/// What a benchmark shows: likeness, copying, diversity, seams (the worse of the two) and seconds.
std::vector<BenchmarkColumn> benchmark_columns();

/// The methods of a run that make textures of exemplars, and peers, compared.
struct Benchmark {
  std::vector<BenchmarkColumn> columns;  // those that any row has
  std::vector<BenchmarkRow> rows;
  std::string against;               // see benchmark_rows()
  std::vector<std::string> missing;  // a line for what is not in the rows and should be
};

/// Methods and exemplars of which no job was begun are no part of it. Throws ConfigError for a run
/// without any scored job, and for an `against` that is no method.
Benchmark benchmark_run(const RunOnDisk& run, const PeerScores& peers, const std::string& against);

enum class TableStyle { plain, markdown };

/// A line a method: "0.983 ± 0.004", the mean and half of its interval, and what that means.
std::string benchmark_table(const Benchmark& benchmark, TableStyle style);

/// {"method": {"score": {"mean", "half_width" or null, "exemplars"}, …}, …}
std::string benchmark_json(const Benchmark& benchmark);

}  // namespace gramloom
