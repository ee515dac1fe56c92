#include "jobs/trace_log.h"

#include <cmath>
#include <fstream>

#include "io/text_file.h"

namespace gramloom {

namespace {

double last_seconds(const Trace& trace) {
  return trace.rows.empty() ? 0 : trace.rows.back().seconds;
}

}  // namespace

TraceLog::TraceLog(std::filesystem::path file, std::string mark)
    : file_(std::move(file)),
      mark_("# " + std::move(mark) + "\n"),
      start_(std::chrono::steady_clock::now()) {
  try {
    const std::string text = read_text(file_);
    if (!text.starts_with(mark_)) return;
    trace_ = parse_trace(text);
    seconds_before_ = last_seconds(trace_);
    continues_ = true;
  } catch (const Error&) {
    // No earlier attempt, or nothing of use.
  }
}

void TraceLog::restart() {
  trace_ = {};
  seconds_before_ = 0;
  continues_ = false;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

void TraceLog::add(const Progress& progress) {
  if (!std::isfinite(progress.loss)) return;
  if (!started_) {
    std::erase_if(trace_.rows, [&](const auto& row) { return row.step >= progress.step; });
    seconds_before_ = last_seconds(trace_);
    trace_.terms.clear();
    for (const auto& term : progress.terms) trace_.terms.push_back(term.name);
    write_text(file_, mark_ + to_csv(trace_));
    started_ = true;
  }
  if (!trace_.rows.empty() && trace_.rows.back().step == progress.step) return;
  TraceRow row{progress.step, progress.evaluations, seconds(), progress.loss, {}};
  for (const auto& term : progress.terms) row.terms.push_back(term.value);
  row.terms.resize(trace_.terms.size());
  // Appended, not written whole: a line that is cut off is left out on reading.
  std::ofstream(file_, std::ios::app) << to_csv_line(row) << std::flush;
  trace_.rows.push_back(std::move(row));
}

double TraceLog::seconds() const {
  const double now =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return std::round((seconds_before_ + now) * 1e6) / 1e6;
}

}  // namespace gramloom
