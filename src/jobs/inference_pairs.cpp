#include "jobs/inference_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/random.h"
#include "io/text_file.h"
#include "jobs/map_file.h"
#include "jobs/memory.h"
#include "runs/csv_fields.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view picture_column = "picture";

std::string place_in(const fs::path& table, std::size_t line) {
  return fmt::format("{}:{}", table.string(), line);
}

// With the range that each has in these poses.
std::vector<PoseNumber> numbers_of(const std::vector<std::string>& names,
                                   const std::vector<std::vector<double>>& poses) {
  std::vector<PoseNumber> numbers;
  for (std::size_t k = 0; k < names.size(); ++k) {
    PoseNumber& number = numbers.emplace_back(names[k], poses.front()[k], poses.front()[k]);
    for (const auto& pose : poses) {
      number.low = std::min(number.low, pose[k]);
      number.high = std::max(number.high, pose[k]);
    }
  }
  return numbers;
}

double number_of(const std::string& cell) {
  const auto value = from_cell<double>(cell);
  if (!std::isfinite(value)) throw Error("'{}' is not a finite number", cell);
  return value;
}

// What follows an open quote would be one cell, and the rest of the table lost.
void check_quotes(const std::string& text, const fs::path& table) {
  std::size_t line = 1, opened = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
      opened = line;
    }
    if (c == '\n') ++line;
  }
  if (quoted) throw Error("{}: a quote is not closed", place_in(table, opened));
}

void check_columns(const CsvRow& columns, const fs::path& table) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].empty()) throw Error("{}: column {} has no name", place_in(table, 1), i + 1);
    if (std::count(columns.begin(), columns.end(), columns[i]) > 1)
      throw Error("{}: two columns are called '{}'", place_in(table, 1), columns[i]);
  }
}

// The columns that `names` asks for, all but the pictures' if it asks for none.
std::vector<std::string> number_columns(const CsvRow& columns,
                                        const std::vector<std::string>& names,
                                        const fs::path& file) {
  std::vector<std::string> found;
  for (const std::string& column : columns)
    if (column != picture_column &&
        (names.empty() || std::find(names.begin(), names.end(), column) != names.end()))
      found.push_back(column);
  for (const std::string& name : names)
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

PoseTable parse_columns(std::string text, const fs::path& file,
                        const std::vector<std::string>& names) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // as spreadsheets write it
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  check_quotes(text, file);
  if (!text.ends_with('\n')) text += '\n';
  const std::vector<CsvRow> rows = parse_csv(text);
  const CsvRow& columns = rows.front();
  if (columns.size() == 1 && columns[0].find(';') != std::string::npos)
    throw Error("{}: cells are parted by ';', allowed is ','", place_in(file, 1));
  check_columns(columns, file);
  PoseTable table;
  table.names = number_columns(columns, names, file);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i] == CsvRow{""}) continue;
    try {
      add_row(columns, rows[i], names.empty(), table);
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, i + 1), error.what());
    }
    table.lines.push_back(i + 1);
  }
  return table;
}

Image read_picture(const fs::path& file, InferencePairs& pairs) {
  ImageFile read = read_image(file);
  if (pairs.pictures.empty()) {
    pairs.pixel_type = read.encoding.pixel_type;
    pairs.values = kind_of_map("", {file, {}, {}}, read.image);
    return std::move(read.image);
  }
  const Image& first = pairs.pictures.front();
  if (read.image.size() != first.size() || read.image.channels != first.channels)
    throw Error("{} is of {}×{} with {} channels, the first picture of {}×{} with {}",
                file.string(), read.image.width, read.image.height, read.image.channels,
                first.width, first.height, first.channels);
  return std::move(read.image);
}

}  // namespace

PoseTable read_pose_table(const fs::path& file) { return read_pose_table(file, {}); }

PoseTable read_pose_table(const fs::path& file, const std::vector<std::string>& names) {
  return parse_columns(read_text(file), file, names);
}

PoseTable parse_pose_table(std::string text, const fs::path& file) {
  return parse_columns(std::move(text), file, {});
}

void check_pairs(const PoseTable& table, const fs::path& file) {
  const std::size_t count = table.poses.size();
  if (table.pictures.empty() && count > 0)
    throw Error("{}: has no column '{}'", place_in(file, 1), picture_column);
  if (count < fewest_pairs)
    throw Error("{}: has {} pairs, needed are {} at least", file.string(), count, fewest_pairs);
}

void check_pictures(const PoseTable& table, const fs::path& file) {
  Size first;
  for (std::size_t i = 0; i < table.pictures.size(); ++i) {
    const fs::path picture = file.parent_path() / table.pictures[i];
    try {
      Size size = read_image_size(picture);
      if (size.width > size.height) std::swap(size.width, size.height);  // EXIF may turn it yet
      if (i == 0) first = size;
      if (size != first)
        throw Error("{} has sides of {} and {}, the first picture of {} and {}", picture.string(),
                    size.width, size.height, first.width, first.height);
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, table.lines[i]), error.what());
    }
  }
}

InferencePairs read_pairs(const fs::path& file, FileHashes& hashes) {
  PoseTable table = read_pose_table(file);
  check_pairs(table, file);
  const std::size_t count = table.poses.size();
  InferencePairs pairs;
  std::string all = hashes.of(file);
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path picture = file.parent_path() / table.pictures[i];
    try {
      pairs.pictures.push_back(read_picture(picture, pairs));
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, table.lines[i]), error.what());
    }
    all += hashes.of(picture);
    // Twice: as they are, and as they are trained on.
    const double bytes =
        8.0 * static_cast<double>(count) * static_cast<double>(pairs.pictures[0].pixels.size());
    if (i == 0 && bytes > available_memory())
      throw Error("{}: {} pictures need about {:.1f} GB of memory, {:.1f} GB are free",
                  file.string(), count, bytes / 1e9, available_memory() / 1e9);
  }
  pairs.numbers = numbers_of(table.names, table.poses);
  pairs.poses = std::move(table.poses);
  pairs.hash = hash_of(all);
  return pairs;
}

PairSplit split_pairs(std::size_t count, double share, int seed) {
  const auto wanted = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
  const std::size_t held_out = std::clamp<std::size_t>(wanted, 2, count / 2);
  Random random(static_cast<std::uint64_t>(seed));
  PairSplit split;
  std::size_t next = 0;
  for (std::size_t i = 0; i < held_out; ++i) {
    const std::size_t first = i * count / held_out, end = (i + 1) * count / held_out;
    const std::size_t chosen = first + random.below(static_cast<std::uint32_t>(end - first));
    for (; next < end; ++next)
      if (next != chosen) split.learnt.push_back(next);
    (i % 2 == 0 ? split.chosen_by : split.tested).push_back(chosen);
  }
  return split;
}

std::vector<PoseNumber> learnt_numbers(const PoseTable& table, const PairSplit& split) {
  std::vector<std::vector<double>> learnt;
  for (const std::size_t i : split.learnt) learnt.push_back(table.poses[i]);
  return numbers_of(table.names, learnt);
}

InferencePairs select_pairs(const InferencePairs& pairs, const std::vector<std::size_t>& wanted) {
  InferencePairs some{pairs.numbers, {}, {}, pairs.pixel_type, pairs.values, pairs.hash};
  for (const std::size_t i : wanted) {
    some.poses.push_back(pairs.poses[i]);
    some.pictures.push_back(pairs.pictures[i]);
  }
  std::vector<std::string> names;
  for (const PoseNumber& number : pairs.numbers) names.push_back(number.name);
  some.numbers = numbers_of(names, some.poses);
  return some;
}

}  // namespace gramloom
