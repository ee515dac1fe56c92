#pragma once

#include <charconv>

#include "io/field_values.h"
#include "runs/csv.h"

namespace gramloom {

// Structs as lines of a table, through their field lists: the columns are named like the fields. A
// table has no version: its columns' names say what it holds.

/// A number in the shortest form that reads back as the same one.
template <class T>
std::string to_cell(const T& value) {
  if constexpr (is_optional<T>)
    return value ? to_cell(*value) : "";
  else if constexpr (NamedEnum<T>)
    return std::string(to_word(value));
  else if constexpr (is_number<T>)
    return fmt::format("{}", value);
  else
    return value;
}

/// Throws Error "'x' is no number".
template <class T>
T from_cell(const std::string& cell) {
  if constexpr (is_optional<T>) {
    if (cell.empty()) return std::nullopt;
    return from_cell<typename T::value_type>(cell);
  } else if constexpr (NamedEnum<T>) {
    for (std::size_t i = 0; i < enum_names<T>.size(); ++i)
      if (enum_names<T>[i] == cell) return static_cast<T>(i);
    throw Error("'{}' is not {}", cell, allowed_values<T>({}));
  } else if constexpr (is_number<T>) {
    T value{};
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || stop != end)
      throw Error("'{}' is not {}", cell, allowed_values<T>({}));
    return value;
  } else {
    return cell;
  }
}

/// The names of the fields, and then `more`.
template <class Row>
CsvRow field_columns(const std::vector<std::string>& more) {
  CsvRow columns;
  for_each_field<Row>([&](const auto& field) { columns.emplace_back(field.name); });
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

template <class Row>
inline constexpr std::size_t field_count = std::tuple_size_v<decltype(Row::fields())>;

/// The fields, and then `more`.
template <class Row, class T>
CsvRow field_cells(const Row& row, const std::vector<T>& more) {
  CsvRow cells;
  for_each_value(row,
                 [&](const FieldText&, const auto& value) { cells.push_back(to_cell(value)); });
  for (const T& value : more) cells.push_back(to_cell(value));
  return cells;
}

/// The reverse. `cells` must be as many as the fields at least. Throws Error with the column.
template <class Row, class T>
Row row_of_cells(const CsvRow& cells, std::vector<T> Row::*more) {
  Row row;
  std::size_t column = 0;
  for_each_value(row, [&]<class Value>(const FieldText& field, Value& value) {
    try {
      value = from_cell<Value>(cells.at(column++));
    } catch (const Error& error) {
      throw Error("{}: {}", field.name, error.what());
    }
  });
  for (; column < cells.size(); ++column) (row.*more).push_back(from_cell<T>(cells[column]));
  return row;
}

}  // namespace gramloom
