#include "jobs/benchmark_table.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "io/field_values.h"
#include "io/json_text.h"
#include "jobs/text_table.h"
#include "metrics/scores.h"

namespace gramloom {

namespace {

// Why a job is not in the rows, or "".
std::string lack_of(const JobRecord& record) {
  if (record.status != Status::done)
    return fmt::format("{}{}{}", to_word(record.status), record.error.empty() ? "" : ": ",
                       record.error);
  if (!record.metrics.empty()) return "";
  return record.score_error.empty() ? "not scored"
                                    : fmt::format("not scored: {}", record.score_error);
}

// The jobs of methods with an exemplar, but for methods and exemplars of which none was begun: the
// run was of a part (--only), or ended before them.
std::vector<NamedRecord> compared_jobs(const RunOnDisk& run) {
  std::set<std::string> methods, exemplars;
  for (const JobOnDisk& job : run.jobs) {
    if (job.record.status == Status::waiting) continue;
    methods.insert(job.record.method);
    exemplars.insert(job.record.exemplar);
  }
  std::vector<NamedRecord> jobs;
  for (const JobOnDisk& job : run.jobs)
    if (job.record.kind != "procedural" && methods.contains(job.record.method) &&
        exemplars.contains(job.record.exemplar))
      jobs.push_back({job.name, job.record});
  return jobs;
}

// A line for each method that lacks jobs, with the first of them.
std::vector<std::string> lacking_jobs(const std::vector<std::string>& methods,
                                      const std::vector<NamedRecord>& jobs) {
  std::vector<std::string> lines;
  for (const std::string& method : methods) {
    std::size_t all = 0, lacking = 0;
    std::string first;
    for (const auto& [name, record] : jobs) {
      if (record.method != method) continue;
      ++all;
      const std::string lack = lack_of(record);
      if (!lack.empty() && lacking++ == 0) first = fmt::format("{} ({})", name, lack);
    }
    if (lacking > 0)
      lines.push_back(fmt::format("{}: without {} of {} jobs: {}{}", method, lacking, all, first,
                                  lacking > 1 ? ", …" : ""));
  }
  return lines;
}

// Leaves out the columns that no row has.
void drop_empty_columns(Benchmark& benchmark) {
  for (std::size_t i = benchmark.columns.size(); i-- > 0;) {
    const auto has = [i](const BenchmarkRow& row) { return row.values[i].has_value(); };
    if (std::ranges::any_of(benchmark.rows, has)) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    benchmark.columns.erase(benchmark.columns.begin() + at);
    for (BenchmarkRow& row : benchmark.rows) row.values.erase(row.values.begin() + at);
  }
}

// Seconds differ by powers of ten.
int digits_of(double value, bool seconds) {
  if (!seconds) return 3;
  return std::abs(value) < 0.1 ? 3 : std::abs(value) < 1 ? 2 : std::abs(value) < 10 ? 1 : 0;
}

// "0.983 ± 0.004", or of a difference "+0.002 ± 0.003".
std::string cell(const std::optional<MeanInterval>& interval, bool seconds, bool difference) {
  if (!interval) return "-";
  const int digits = digits_of(interval->mean, seconds);
  std::string text = difference ? fmt::format("{:+.{}f}", interval->mean, digits)
                                : fmt::format("{:.{}f}", interval->mean, digits);
  if (interval->half_width) text += fmt::format(" ± {:.{}f}", *interval->half_width, digits);
  return text;
}

std::vector<Row> cells_of(const Benchmark& benchmark) {
  std::vector<Row> rows{{"method", "exemplars"}, {"better", ""}};
  for (const BenchmarkColumn& column : benchmark.columns) {
    rows[0].push_back(column.name);
    rows[1].push_back(column.higher_is_better ? "more" : "less");
  }
  for (const BenchmarkRow& row : benchmark.rows) {
    const bool is_difference = !benchmark.against.empty() && row.method != benchmark.against;
    Row cells{row.method, std::to_string(row.exemplars)};
    for (std::size_t i = 0; i < row.values.size(); ++i)
      cells.push_back(cell(row.values[i], benchmark.columns[i].name == "seconds", is_difference));
    rows.push_back(std::move(cells));
  }
  return rows;
}

std::string markdown(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += fmt::format("| {} |\n", fmt::join(row, " | "));
    if (&row != &rows.front()) continue;
    for (std::size_t i = 0; i < row.size(); ++i) text += "|---";
    text += "|\n";
  }
  return text;
}

}  // namespace

std::vector<BenchmarkColumn> benchmark_columns() {
  std::vector<BenchmarkColumn> columns;
  const auto add = [&](const std::string& name, const std::vector<std::string>& scores) {
    const auto found = std::ranges::find(metrics(), scores.front(), &Metric::name);
    columns.push_back({name, scores, found != metrics().end() && found->higher_is_better});
  };
  // The likenesses that take in structure.
  for (const char* score : {"stsim2", "portilla_simoncelli", "random_features"})
    add(score, {score});
  for (const char* score : {"copied_share", "repetition", "diversity"}) add(score, {score});
  add("seam", {"seam_x", "seam_y"});
  add("seconds", {"seconds"});
  return columns;
}

Benchmark benchmark_run(const RunOnDisk& run, const PeerScores& peers, const std::string& against) {
  std::vector<NamedRecord> jobs = compared_jobs(run);
  std::vector<std::string> methods;
  for (const auto& [name, record] : jobs)
    if (std::ranges::find(methods, record.method) == methods.end())
      methods.push_back(record.method);

  Benchmark benchmark{benchmark_columns(), {}, against, lacking_jobs(methods, jobs)};
  benchmark.missing.insert(benchmark.missing.end(), peers.missing.begin(), peers.missing.end());
  std::erase_if(jobs, [](const NamedRecord& job) { return !lack_of(job.record).empty(); });
  if (jobs.empty())
    throw ConfigError("{}: no job of this run has scores{}", run.folder.string(),
                      benchmark.missing.empty() ? "" : " (" + benchmark.missing.front() + ")");
  std::vector<std::string> names;
  for (const Metric& metric : metrics()) names.emplace_back(metric.name);
  ScoreSheet sheet = score_sheet(jobs, run.diversity, names);
  sheet.rows.insert(sheet.rows.end(), peers.rows.begin(), peers.rows.end());
  try {
    benchmark.rows = benchmark_rows(sheet, benchmark.columns, against);
  } catch (const Error& error) {
    throw ConfigError("--against {}: {}", against, error.what());
  }
  drop_empty_columns(benchmark);
  return benchmark;
}

std::string benchmark_table(const Benchmark& benchmark, TableStyle style) {
  const auto rows = cells_of(benchmark);
  std::string text = style == TableStyle::plain ? text_table(rows, "") : markdown(rows);
  text +=
      "\nMeans over exemplars of the means of their seeds, ± half of their 95 % intervals "
      "(Student's, over exemplars).\n";
  if (!benchmark.against.empty())
    text +=
        fmt::format("All but those of '{0}' are differences from '{0}', exemplar by exemplar.\n",
                    benchmark.against);
  return text;
}

std::string benchmark_json(const Benchmark& benchmark) {
  Json json = Json::object();
  for (const BenchmarkRow& row : benchmark.rows)
    for (std::size_t i = 0; i < row.values.size(); ++i)
      if (const auto& value = row.values[i])
        json[row.method][benchmark.columns[i].name] = {
            {"mean", value->mean},
            {"half_width", value->half_width ? Json(*value->half_width) : Json()},
            {"exemplars", value->count}};
  return to_text(json, 2) + "\n";
}

}  // namespace gramloom
