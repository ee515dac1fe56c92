#include "runs/trace_file.h"

#include "runs/csv_fields.h"

namespace gramloom {

namespace {

std::string_view without_comments(std::string_view text) {
  while (text.starts_with('#')) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return text;
}

}  // namespace

std::string to_csv_line(const TraceRow& row) { return csv_line(field_cells(row, row.terms)); }

std::string to_csv(const Trace& trace) {
  std::string csv = csv_line(field_columns<TraceRow>(trace.terms));
  for (const auto& row : trace.rows) csv += to_csv_line(row);
  return csv;
}

Trace parse_trace(const std::string& csv) {
  const std::vector<CsvRow> rows = parse_csv(without_comments(csv));
  Trace trace;
  for (const CsvRow& cells : rows) {
    if (&cells == &rows.front()) {
      if (cells.size() > field_count<TraceRow>)
        trace.terms.assign(cells.begin() + field_count<TraceRow>, cells.end());
    } else if (cells.size() == field_count<TraceRow> + trace.terms.size()) {
      trace.rows.push_back(row_of_cells(cells, &TraceRow::terms));
    }
  }
  return trace;
}

}  // namespace gramloom
