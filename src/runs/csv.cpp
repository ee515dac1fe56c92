#include "runs/csv.h"

#include <utility>

namespace gramloom {

namespace {

std::string csv_cell(std::string_view text) {
  std::string cell(text);
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return cell;
  for (std::size_t i = 0; (i = cell.find('"', i)) != std::string::npos; i += 2)
    cell.insert(i, 1, '"');
  cell.insert(0, 1, '"');
  cell.push_back('"');
  return cell;
}

}  // namespace

std::string csv_line(const CsvRow& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    line += csv_cell(cell);
    line += ',';
  }
  if (!line.empty()) line.back() = '\n';
  return line;
}

std::vector<CsvRow> parse_csv(std::string_view text) {
  std::vector<CsvRow> rows;
  CsvRow row;
  std::string cell;
  bool in_quotes = false;
  const auto end_cell = [&] { row.push_back(std::exchange(cell, "")); };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_quotes) {
      const bool doubled = c == '"' && i + 1 < text.size() && text[i + 1] == '"';
      if (doubled) ++i;
      if (c != '"' || doubled)
        cell += c;
      else
        in_quotes = false;
    } else if (c == '"') {
      in_quotes = true;
    } else if (c == ',') {
      end_cell();
    } else if (c == '\n') {
      if (cell.ends_with('\r')) cell.pop_back();
      end_cell();
      rows.push_back(std::exchange(row, {}));
    } else {
      cell += c;
    }
  }
  return rows;
}

}  // namespace gramloom
