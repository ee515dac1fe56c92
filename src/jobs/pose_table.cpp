#include "jobs/pose_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "io/text_file.h"
#include "runs/csv_fields.h"

namespace gramloom {

std::string place_in(const std::filesystem::path& table, std::size_t line) {
  return fmt::format("{}:{}", table.string(), line);
}

namespace {

namespace fs = std::filesystem;

// The columns that are read, and no pictures; none: those of a table of pairs.
using Wanted = std::optional<std::vector<std::string>>;

double number_of(const std::string& cell) {
  const auto value = from_cell<double>(cell);
  if (!std::isfinite(value)) throw Error("'{}' is not a finite number", cell);
  return value;
}

// The line on which each row begins: a quoted cell may have line breaks. What follows an open quote
// would be one cell, and the rest of the table lost.
std::vector<std::size_t> lines_of_rows(const std::string& text, const fs::path& table) {
  std::vector<std::size_t> lines{1};
  std::size_t line = 1, opened = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
      opened = line;
    }
    if (c != '\n') continue;
    ++line;
    if (!quoted) lines.push_back(line);
  }
  if (quoted) throw Error("{}: a quote is not closed", place_in(table, opened));
  return lines;
}

void check_columns(const CsvRow& columns, const fs::path& table) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].empty()) throw Error("{}: column {} has no name", place_in(table, 1), i + 1);
    if (std::count(columns.begin(), columns.end(), columns[i]) > 1)
      throw Error("{}: two columns are called '{}'", place_in(table, 1), columns[i]);
  }
}

// The columns that `wanted` names; of a table of pairs all but the pictures'.
std::vector<std::string> number_columns(const CsvRow& columns, const Wanted& wanted,
                                        const fs::path& file) {
  std::vector<std::string> found;
  for (const std::string& column : columns)
    if (column != picture_column &&
        (!wanted || std::find(wanted->begin(), wanted->end(), column) != wanted->end()))
      found.push_back(column);
  for (const std::string& name : wanted.value_or(std::vector<std::string>{}))
    if (std::find(found.begin(), found.end(), name) == found.end())
      throw Error("{}: has no column '{}', one of the model's", place_in(file, 1), name);
  if (found.empty()) throw Error("{}: has no column of numbers", place_in(file, 1));
  return found;
}

void add_row(const CsvRow& columns, const CsvRow& row, bool of_pairs, PoseTable& table) {
  if (row.size() != columns.size())
    throw Error("{} cells, the first line has {}", row.size(), columns.size());
  std::vector<double>& pose = table.poses.emplace_back();
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (columns[i] == picture_column) {
      if (of_pairs && row[i].empty()) throw Error("names no picture");
      if (of_pairs) table.pictures.push_back(row[i]);
    } else if (std::find(table.names.begin(), table.names.end(), columns[i]) != table.names.end()) {
      try {
        pose.push_back(number_of(row[i]));
      } catch (const Error& error) {
        throw Error("{}: {}", columns[i], error.what());
      }
    }
  }
}

PoseTable parse_columns(std::string text, const fs::path& file, const Wanted& wanted) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // as spreadsheets write it
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  if (!text.ends_with('\n')) text += '\n';
  const std::vector<std::size_t> lines = lines_of_rows(text, file);
  const std::vector<CsvRow> rows = parse_csv(text);
  const CsvRow& columns = rows.front();
  if (columns.size() == 1 && columns[0].find(';') != std::string::npos)
    throw Error("{}: cells are parted by ';', allowed is ','", place_in(file, 1));
  check_columns(columns, file);
  PoseTable table;
  table.names = number_columns(columns, wanted, file);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i] == CsvRow{""}) continue;
    try {
      add_row(columns, rows[i], !wanted, table);
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, lines[i]), error.what());
    }
    table.lines.push_back(lines[i]);
  }
  return table;
}

}  // namespace

PoseTable read_pose_table(const fs::path& file) {
  return parse_columns(read_text(file), file, std::nullopt);
}

PoseTable read_pose_table(const fs::path& file, const std::vector<std::string>& names) {
  return parse_columns(read_text(file), file, names);
}

PoseTable parse_pose_table(std::string text, const fs::path& file) {
  return parse_columns(std::move(text), file, std::nullopt);
}

}  // namespace gramloom
