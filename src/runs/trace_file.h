#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// "1,2,0.031000,0.5" and the terms, with a line end.
std::string to_csv_line(const TraceRow& row);
/// "step,evaluations,seconds,loss,<terms>" and a line a row. Numbers come back as they were.
std::string to_csv(const Trace& trace);
/// The reverse. A last line that is not whole is left out, and so are lines that begin with #.
Trace parse_trace(const std::string& csv);

}  // namespace gramloom
