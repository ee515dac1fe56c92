#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gramloom {

// Tables as RFC 4180 has them, but for line ends: ours are "\n". Cells that hold a comma, a quote
// or a line end stand in quotes.

using CsvRow = std::vector<std::string>;

/// One line with its end.
std::string csv_line(const CsvRow& cells);

/// The lines of a table. A last line without its end is not whole and is left out.
std::vector<CsvRow> parse_csv(std::string_view text);

}  // namespace gramloom
