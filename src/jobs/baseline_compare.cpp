#include "jobs/baseline_compare.h"

#include <algorithm>
#include <cmath>

#include "io/image_algorithms.h"
#include "io/image_file.h"
#include "metrics/scores.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::string shape_of(const Image& image) {
  return fmt::format("{}×{}, {} channels", image.width, image.height, image.channels);
}

// The two runs, and what was found so far.
struct Comparison {
  const Baseline& before;
  const Baseline& now;
  const BaselineLimits& limits;
  std::vector<Change> changes;

  void add(const std::string& job, std::string what, std::string was, std::string is,
           Verdict verdict) {
    changes.push_back({verdict, job, std::move(what), std::move(was), std::move(is)});
  }
};

std::string text_of(const Json& json) { return to_text(json); }

// Whether a setting that both runs know is another one now. A setting that only one of them knows
// came or went with a version of the program: it may not change what the others make.
bool compare_settings(Comparison& c, const std::string& job, const std::string& path,
                      const Json& before, const Json& now) {
  bool differs = false;
  for (const auto& [key, was] : before.items()) {
    const std::string name = path + key;
    const auto is = now.find(key);
    if (is == now.end()) {
      c.add(job, name, text_of(was), "-", Verdict::changed);
    } else if (was.is_object() && is->is_object()) {
      differs |= compare_settings(c, job, name + "/", was, *is);
    } else if (was != *is) {
      c.add(job, name, text_of(was), text_of(*is), Verdict::changed);
      differs = true;
    }
  }
  for (const auto& [key, is] : now.items())
    if (!before.contains(key)) c.add(job, path + key, "-", text_of(is), Verdict::changed);
  return differs;
}

void compare_picture(Comparison& c, const std::string& job, const std::string& before_name,
                     const std::string& now_name, Verdict verdict) {
  const fs::path folder = fs::path(job).parent_path();
  const Image before = read_image(c.before.folder / folder / before_name).image;
  const Image now = read_image(c.now.folder / folder / now_name).image;
  if (before.size() != now.size() || before.channels != now.channels) {
    c.add(job, now_name, shape_of(before), shape_of(now), verdict);
    return;
  }
  const PixelDifference found = difference(before, now, c.limits.pixel_tolerance);
  if (found.share > c.limits.pixel_share || found.largest > c.limits.pixel_limit)
    c.add(
        job, now_name, "",
        fmt::format("{:.2f} % of pixels differ, by up to {:.3f}", 100 * found.share, found.largest),
        verdict);
}

// The texture and its maps, by their place in the record.
void compare_pictures(Comparison& c, const std::string& job, const JobRecord& before,
                      const JobRecord& now, Verdict verdict) {
  const std::size_t both = std::min(before.files.size(), now.files.size());
  for (std::size_t i = 0; i < both; ++i)
    compare_picture(c, job, before.files[i], now.files[i], verdict);
  for (std::size_t i = both; i < before.files.size(); ++i)
    c.add(job, before.files[i], "there", "gone", verdict);
  for (std::size_t i = both; i < now.files.size(); ++i)
    c.add(job, now.files[i], "-", "new", Verdict::changed);
}

// How far a score is from where it cannot be improved.
double distance_from_best(const Metric& metric, double score) {
  return std::max(0.0, metric.higher_is_better ? metric.best - score : score - metric.best);
}

void compare_score(Comparison& c, const std::string& job, const Metric& metric, double before,
                   double now) {
  const double was = distance_from_best(metric, before);
  const double is = distance_from_best(metric, now);
  const double change = (is - was) / std::max(was, c.limits.score_floor);
  if (std::abs(change) <= c.limits.score_change) return;
  c.add(job, std::string(metric.name), fmt::format("{:.4g}", before), fmt::format("{:.4g}", now),
        change > 0 ? Verdict::worse : Verdict::better);
}

std::optional<double> score_of(const JobRecord& record, const Metric& metric) {
  const auto found = record.metrics.find(std::string(metric.name));
  return found == record.metrics.end() ? std::nullopt : found->second;
}

void compare_scores(Comparison& c, const std::string& job, const JobRecord& before,
                    const JobRecord& now) {
  if (!now.score_error.empty() && !before.metrics.empty())
    c.add(job, "scores", "there", now.score_error, Verdict::worse);
  if (now.metrics.empty() || before.metrics.empty()) return;
  for (const Metric& metric : metrics()) {
    const std::optional<double> was = score_of(before, metric);
    const std::optional<double> is = score_of(now, metric);
    if (was && is)
      compare_score(c, job, metric, *was, *is);
    else if (was)
      c.add(job, std::string(metric.name), fmt::format("{:.4g}", *was), "undefined",
            Verdict::changed);
  }
}

void compare_job(Comparison& c, const std::string& job, const JobRecord& before,
                 const JobRecord& now) {
  if (before.status != now.status)
    c.add(job, "status", std::string(to_word(before.status)), std::string(to_word(now.status)),
          before.status == Status::done ? Verdict::worse
          : now.status == Status::done  ? Verdict::better
                                        : Verdict::changed);
  const bool other_settings = compare_settings(c, job, "", before.settings, now.settings);
  if (before.status != Status::done || now.status != Status::done) return;
  compare_pictures(c, job, before, now, other_settings ? Verdict::changed : Verdict::worse);
  compare_scores(c, job, before, now);
}

void compare_diversity(Comparison& c) {
  const auto metric = std::find_if(metrics().begin(), metrics().end(),
                                   [](const Metric& m) { return m.name == "diversity"; });
  for (const SeedDiversity& before : c.before.diversity)
    for (const SeedDiversity& now : c.now.diversity)
      if (before.exemplar == now.exemplar && before.method == now.method &&
          before.seeds == now.seeds)
        compare_score(c, before.exemplar + "/" + before.method, *metric, before.value, now.value);
}

}  // namespace

std::vector<Change> compare(const Baseline& before, const Baseline& now,
                            const BaselineLimits& limits) {
  Comparison c{before, now, limits, {}};
  for (const auto& [job, record] : before.jobs) {
    const auto found = now.jobs.find(job);
    if (found == now.jobs.end())
      c.add(job, "job", std::string(to_word(record.status)), "gone",
            record.status == Status::done ? Verdict::worse : Verdict::changed);
    else
      compare_job(c, job, record, found->second);
  }
  for (const auto& [job, record] : now.jobs)
    if (!before.jobs.contains(job))
      c.add(job, "job", "-", fmt::format("new, {}", to_word(record.status)), Verdict::changed);
  compare_diversity(c);
  return c.changes;
}

}  // namespace gramloom
