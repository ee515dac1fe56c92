#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "core/progress.h"
#include "runs/trace_file.h"

namespace gramloom {

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
