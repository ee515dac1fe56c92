#include "runs/benchmark.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.h"

namespace gramloom {

namespace {

// A column's values by exemplar.
using ByExemplar = std::map<std::string, double>;

std::optional<double> score_in(const ScoreSheet& sheet, const ScoreRow& row,
                               const std::string& metric) {
  if (metric == "seconds") return row.seconds;
  const auto found = std::ranges::find(sheet.metrics, metric);
  if (found == sheet.metrics.end()) return std::nullopt;
  return row.scores.at(static_cast<std::size_t>(found - sheet.metrics.begin()));
}

// The largest of those that the job has.
std::optional<double> value_in(const ScoreSheet& sheet, const ScoreRow& row,
                               const BenchmarkColumn& column) {
  std::optional<double> largest;
  for (const std::string& metric : column.metrics)
    largest = std::max(largest, score_in(sheet, row, metric));  // nothing is less than any value
  return largest;
}

ByExemplar means_of_seeds(const ScoreSheet& sheet, const std::string& method,
                          const BenchmarkColumn& column) {
  std::map<std::string, std::vector<double>> seeds;
  for (const ScoreRow& row : sheet.rows)
    if (row.method == method && row.status == Status::done)
      if (const auto value = value_in(sheet, row, column)) seeds[row.exemplar].push_back(*value);
  ByExemplar means;
  for (const auto& [exemplar, values] : seeds)
    means[exemplar] =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return means;
}

ByExemplar difference(const ByExemplar& of, const ByExemplar& from) {
  ByExemplar differences;
  for (const auto& [exemplar, value] : of)
    if (const auto other = from.find(exemplar); other != from.end())
      differences[exemplar] = value - other->second;
  return differences;
}

std::vector<std::string> methods_in(const ScoreSheet& sheet) {
  std::vector<std::string> methods;
  for (const ScoreRow& row : sheet.rows)
    if (std::ranges::find(methods, row.method) == methods.end()) methods.push_back(row.method);
  return methods;
}

}  // namespace

std::vector<BenchmarkRow> benchmark_rows(const ScoreSheet& sheet,
                                         const std::vector<BenchmarkColumn>& columns,
                                         const std::string& against) {
  const std::vector<std::string> methods = methods_in(sheet);
  if (!against.empty() && std::ranges::find(methods, against) == methods.end())
    throw Error("there is no method '{}', only {}", against, fmt::join(methods, ", "));
  std::vector<BenchmarkRow> rows;
  for (const std::string& method : methods) {
    BenchmarkRow row{method, 0, {}};
    std::set<std::string> exemplars;
    for (const BenchmarkColumn& column : columns) {
      ByExemplar means = means_of_seeds(sheet, method, column);
      if (!against.empty() && method != against)
        means = difference(means, means_of_seeds(sheet, against, column));
      std::vector<double> values;
      for (const auto& [exemplar, value] : means) {
        exemplars.insert(exemplar);
        values.push_back(value);
      }
      row.values.push_back(values.empty() ? std::nullopt : std::optional(mean_interval(values)));
    }
    row.exemplars = static_cast<int>(exemplars.size());
    if (row.exemplars > 0) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gramloom
