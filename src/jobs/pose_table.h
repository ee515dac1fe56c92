#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gramloom {

/// The column of a table of pairs that names the pictures.
inline constexpr std::string_view picture_column = "picture";

/// A table of poses: its first line names the columns, lines of nothing count for none.
struct PoseTable {
  std::vector<std::string> names;  // of the numbers
  std::vector<std::vector<double>> poses;
  std::vector<std::string> pictures;  // of the column 'picture', if there is one
  std::vector<std::size_t> lines;     // on which each pose begins
};
/// Throws Error in one line with file and line: no numbers, two columns of one name, a row of
/// another number of cells, a cell that is no number, a row without its picture.
PoseTable read_pose_table(const std::filesystem::path& table);
/// Only the columns of these names, in the table's order: others may hold anything, and there are
/// no pictures. Throws Error too where one is missing.
PoseTable read_pose_table(const std::filesystem::path& table,
                          const std::vector<std::string>& names);
/// As the first, of a text; `table` is what errors call it.
PoseTable parse_pose_table(std::string text, const std::filesystem::path& table);

/// As errors name a line of it.
std::string place_in(const std::filesystem::path& table, std::size_t line);

}  // namespace gramloom
