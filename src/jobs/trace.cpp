#include "jobs/trace.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "io/text_file.h"

namespace gramloom {

namespace {

constexpr std::size_t fixed_columns = 4;

std::string to_line(const TraceRow& row) {
  // Shortest form that reads back as the same number; microseconds are enough for times.
  std::string line =
      fmt::format("{},{},{:.6f},{}", row.step, row.evaluations, row.seconds, row.loss);
  for (const double term : row.terms) line += fmt::format(",{}", term);
  return line + "\n";
}

std::string header(const Trace& trace) {
  std::string line = "step,evaluations,seconds,loss";
  for (const auto& term : trace.terms) line += "," + term;
  return line + "\n";
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

double last_seconds(const Trace& trace) {
  return trace.rows.empty() ? 0 : trace.rows.back().seconds;
}

TraceRow parse_row(const std::vector<std::string>& cells) {
  TraceRow row{
      std::stoll(cells[0]), std::stoll(cells[1]), std::stod(cells[2]), std::stod(cells[3]), {}};
  for (std::size_t i = fixed_columns; i < cells.size(); ++i)
    row.terms.push_back(std::stod(cells[i]));
  return row;
}

}  // namespace

std::string to_csv(const Trace& trace) {
  std::string csv = header(trace);
  for (const auto& row : trace.rows) csv += to_line(row);
  return csv;
}

Trace parse_trace(const std::string& csv) {
  Trace trace;
  std::istringstream lines(csv.substr(0, csv.rfind('\n') + 1));
  bool named = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    const auto cells = split(line);
    if (!named) {
      if (cells.size() > fixed_columns)
        trace.terms.assign(cells.begin() + fixed_columns, cells.end());
      named = true;
    } else if (cells.size() == fixed_columns + trace.terms.size()) {
      try {
        trace.rows.push_back(parse_row(cells));
      } catch (const std::exception&) {
        throw Error("'{}' is no line of a trace", line);
      }
    }
  }
  return trace;
}

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
  std::ofstream(file_, std::ios::app) << to_line(row) << std::flush;
  trace_.rows.push_back(std::move(row));
}

double TraceLog::seconds() const {
  return seconds_before_ +
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace gramloom
