#include "runs/trace_file.h"

#include <fmt/format.h>

#include <sstream>

#include "core/error.h"

namespace gramloom {

namespace {

constexpr std::size_t fixed_columns = 4;

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

TraceRow parse_row(const std::vector<std::string>& cells) {
  TraceRow row{
      std::stoll(cells[0]), std::stoll(cells[1]), std::stod(cells[2]), std::stod(cells[3]), {}};
  for (std::size_t i = fixed_columns; i < cells.size(); ++i)
    row.terms.push_back(std::stod(cells[i]));
  return row;
}

}  // namespace

std::string to_csv_line(const TraceRow& row) {
  // Shortest form that reads back as the same number; microseconds are enough for times.
  std::string line =
      fmt::format("{},{},{:.6f},{}", row.step, row.evaluations, row.seconds, row.loss);
  for (const double term : row.terms) line += fmt::format(",{}", term);
  return line + "\n";
}

std::string to_csv(const Trace& trace) {
  std::string csv = header(trace);
  for (const auto& row : trace.rows) csv += to_csv_line(row);
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

}  // namespace gramloom
