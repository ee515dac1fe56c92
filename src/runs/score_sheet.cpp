#include "runs/score_sheet.h"

#include <map>

#include "runs/csv_fields.h"

namespace gramloom {

namespace {

std::optional<double> score_of(const JobRecord& record, const std::string& metric) {
  const auto score = record.metrics.find(metric);
  return score == record.metrics.end() ? std::nullopt : score->second;
}

}  // namespace

ScoreSheet score_sheet(const std::vector<NamedRecord>& jobs,
                       const std::vector<SeedDiversity>& diversity,
                       const std::vector<std::string>& metrics) {
  std::map<std::pair<std::string, std::string>, double> diversities;
  for (const SeedDiversity& of : diversity) diversities[{of.exemplar, of.method}] = of.value;
  ScoreSheet sheet{metrics, {}};
  for (const auto& [name, record] : jobs) {
    ScoreRow row{
        record.exemplar, record.method, record.kind, record.seed, record.status, {}, {}, {}};
    const bool begun = record.status != Status::waiting;
    if (begun) row.seconds = record.seconds, row.peak_memory_mb = record.peak_memory_mb;
    const auto found = diversities.find({record.exemplar, record.method});
    for (const auto& metric : metrics)
      if (metric != "diversity")
        row.scores.push_back(score_of(record, metric));
      else
        row.scores.push_back(begun && found != diversities.end() ? std::optional(found->second)
                                                                 : std::nullopt);
    sheet.rows.push_back(std::move(row));
  }
  return sheet;
}

std::string to_csv(const ScoreSheet& sheet) {
  std::string csv = csv_line(field_columns<ScoreRow>(sheet.metrics));
  for (const ScoreRow& row : sheet.rows) csv += csv_line(field_cells(row, row.scores));
  return csv;
}

ScoreSheet parse_score_sheet(const std::string& csv) {
  const std::vector<CsvRow> rows = parse_csv(csv);
  ScoreSheet sheet;
  for (const CsvRow& cells : rows) {
    if (cells.size() < field_count<ScoreRow>)
      throw Error("line {} of the table of scores has {} cells, allowed are at least {}",
                  &cells - rows.data() + 1, cells.size(), field_count<ScoreRow>);
    if (&cells == &rows.front())
      sheet.metrics.assign(cells.begin() + field_count<ScoreRow>, cells.end());
    else
      sheet.rows.push_back(row_of_cells(cells, &ScoreRow::scores));
  }
  return sheet;
}

}  // namespace gramloom
