#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"

namespace gramloom {

/// The loss of an iterative method, step by step.
struct TraceRow {
  std::int64_t step = 0;
  std::int64_t evaluations = 0;  // since the start
  double seconds = 0;            // since the start
  double loss = 0;
  std::vector<double> terms;

  friend bool operator==(const TraceRow&, const TraceRow&) = default;
};

struct Trace {
  std::vector<std::string> terms;  // names
  std::vector<TraceRow> rows;

  friend bool operator==(const Trace&, const Trace&) = default;
};

/// "step,evaluations,seconds,loss,<terms>" and a line a row. Numbers come back as they were.
std::string to_csv(const Trace& trace);
/// The reverse. A last line that is not whole is left out, and so are lines that begin with #.
Trace parse_trace(const std::string& csv);

/// The trace of a job that is under way. It stands on disk from the first row on, beside the
/// method's checkpoint, so that a job that was killed can go on with both; `mark` in its first line
/// says which settings both belong to.
class TraceLog {
 public:
  TraceLog(std::filesystem::path file, std::string mark);

  /// Whether `file` holds rows that were written with this mark.
  bool continues() const { return continues_; }
  /// Forgets what an earlier attempt left.
  void restart();
  /// Adds a row when the report is of an iterative method and of a new step. The first one after an
  /// earlier attempt takes the place of the rows from its step on: those were after the checkpoint.
  void add(const Progress& progress);

  const Trace& trace() const { return trace_; }
  /// Since the start, over all attempts.
  double seconds() const;

 private:
  std::filesystem::path file_;
  std::string mark_;
  Trace trace_;
  bool continues_ = false;
  bool started_ = false;
  double seconds_before_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace gramloom
