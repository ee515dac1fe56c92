#include "runs/score_sheet.h"

namespace gramloom {

namespace {

// As RFC 4180 has it: a cell with a comma or a quote stands in quotes.
std::string cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string line_of(const std::vector<std::string>& cells) {
  return fmt::format("{}\n", fmt::join(cells, ","));
}

std::string score_cell(const JobState& job, std::string_view metric,
                       const std::vector<SeedDiversity>& diversity) {
  if (metric == "diversity") {
    for (const SeedDiversity& of : diversity)
      if (of.exemplar == job.exemplar && of.method == job.method)
        return fmt::format("{}", of.value);
    return "";
  }
  const auto score = job.record->metrics.find(metric);
  return score == job.record->metrics.end() || !score->is_number()
             ? ""
             : fmt::format("{}", score->get<double>());
}

}  // namespace

std::string score_sheet(const std::vector<JobState>& jobs,
                        const std::vector<SeedDiversity>& diversity,
                        const std::vector<std::string>& metrics) {
  std::vector<std::string> header{"exemplar", "method",  "kind",          "seed",
                                  "status",   "seconds", "peak_memory_mb"};
  header.insert(header.end(), metrics.begin(), metrics.end());
  std::string sheet = line_of(header);
  for (const JobState& job : jobs) {
    std::vector<std::string> cells{cell(job.exemplar), cell(job.method), cell(job.kind),
                                   fmt::format("{}", job.seed), std::string(job.status())};
    if (job.record) {
      cells.push_back(fmt::format("{:.6g}", job.record->seconds));
      cells.push_back(fmt::format("{:.6g}", job.record->peak_memory_mb));
      for (const auto& metric : metrics) cells.push_back(score_cell(job, metric, diversity));
    }
    cells.resize(header.size());
    sheet += line_of(cells);
  }
  return sheet;
}

}  // namespace gramloom
