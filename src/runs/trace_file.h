#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// The loss of an iterative method, step by step.
struct TraceRow {
  std::int64_t step = 0;
  std::int64_t evaluations = 0;  // since the start
  double seconds = 0;            // since the start
  double loss = 0;
  std::vector<double> terms;

  friend bool operator==(const TraceRow&, const TraceRow&) = default;

  static constexpr auto fields() {
    using T = TraceRow;
    return std::tuple{
        Field{"step", &T::step, "steps done"},
        Field{"evaluations", &T::evaluations, "of the loss, since the start"},
        Field{"seconds", &T::seconds, "since the start", "s"},
        Field{"loss", &T::loss, "the weighted sum of its terms"},
    };
  }
};

struct Trace {
  std::vector<std::string> terms;  // names
  std::vector<TraceRow> rows;

  friend bool operator==(const Trace&, const Trace&) = default;
};

/// "1,2,0.031,0.5" and the terms, with a line end.
std::string to_csv_line(const TraceRow& row);
/// A table (csv.h) "step,evaluations,seconds,loss,<terms>". Numbers and names come back as they
/// were.
std::string to_csv(const Trace& trace);
/// The reverse. Left out are the lines at the beginning that start with # (they are no part of the
/// table), a last line that is not whole, and lines with another number of cells than the first.
/// Throws Error for a cell that is no number.
Trace parse_trace(const std::string& csv);

}  // namespace gramloom
