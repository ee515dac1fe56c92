#include "jobs/job_scores.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "io/text_file.h"
#include "jobs/interruption.h"
#include "jobs/memory.h"
#include "jobs/usable_part.h"
#include "metrics/copying.h"
#include "metrics/map_scores.h"
#include "metrics/seams.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

using nlohmann::literals::operator""_json_pointer;

JobRecord::Values values_of(const std::vector<std::pair<std::string_view, double>>& scores) {
  JobRecord::Values values;
  for (const auto& [name, value] : scores)
    values[std::string(name)] = std::isfinite(value) ? std::optional(value) : std::nullopt;
  return values;
}

// A map as its file holds it, in the values that the joined exemplar has.
Image read_map(const std::filesystem::path& path, const ExemplarFile& file) {
  ImageFile map = read_image(path);
  const PixelType type = map.encoding.pixel_type;
  const bool integer = type == PixelType::uint8 || type == PixelType::uint16;
  if (!integer && (file.low != 0 || file.high != 1))
    for (float& value : map.image.pixels) value = (value - file.low) / (file.high - file.low);
  return std::move(map.image);
}

// Those of the exemplar's maps that the texture has; of several pictures, the first one's.
std::map<std::string, JobRecord::Values> map_values(Run& run, const Job& job, const JobFiles& files,
                                                    const JobRecord& record) {
  std::map<std::string, JobRecord::Values> all;
  const Image& joined = request_of(run, job).exemplars.front().image;
  int first = 0;
  for (const ExemplarFile& file : run.files) {
    const auto own = std::ranges::find_if(record.files, [&](const std::string& name) {
      return !file.map.empty() &&
             std::filesystem::path(name).stem() == fmt::format("{}_{}", files.name, file.map);
    });
    if (own != record.files.end())
      all[file.map] = values_of(score_map(extract_channels(joined, first, file.channels),
                                          read_map(files.folder / *own, file), file.kind));
    first += file.channels;
  }
  return all;
}

// How much of the material each exemplar is: by its weight, or by how much of it may be used.
std::vector<double> shares_of(const Request& request) {
  const std::size_t count = request.exemplars.size();
  std::vector<double> shares(count);
  const std::vector<float>& weights = request.target.weights.pixels;
  for (std::size_t p = 0; p < weights.size(); p += count) {
    const double sum =
        std::accumulate(weights.begin() + static_cast<std::ptrdiff_t>(p),
                        weights.begin() + static_cast<std::ptrdiff_t>(p + count), 0.0);
    for (std::size_t i = 0; i < count; ++i) shares[i] += static_cast<double>(weights[p + i]) / sum;
  }
  if (weights.empty())
    for (std::size_t i = 0; i < count; ++i) {
      const Rectangle part = usable_part(request.exemplars[i]);
      shares[i] = 1.0 * part.width * part.height;
    }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

// Against each of the exemplar's pictures, and then the mean: by their shares, or of copies the
// sum, since each is of a copy from one of them.
Scores scores_of(Run& run, const PlannedJob& planned, const Image& texture) {
  std::vector<ExemplarStatistics>& exemplars = statistics_of(run, planned.job);
  const Request& request = run.request;
  const bool whole = exemplars.size() == 1 && request.exemplars.front().mask.empty();
  const SourceMap& source = source_of(run, planned);
  if (whole) return score(exemplars.front(), texture, run.config.tile, shown_work(run), source);
  const std::vector<double> shares = shares_of(request);
  Scores all;
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    Scores one = score(exemplars[i], texture, run.config.tile, shown_work(run));
    if (i == 0) {
      all = one;
      for (auto& [name, value] : all.values) value = 0;
    }
    for (std::size_t v = 0; v < one.values.size(); ++v) {
      const bool part = one.values[v].first == "copied_share";
      all.values[v].second += (part ? 1 : shares[i]) * one.values[v].second;
    }
  }
  if (source.empty()) return all;
  std::vector<Size> sizes;
  for (const Exemplar& exemplar : request.exemplars) sizes.push_back(exemplar.image.size());
  all.copy_map = source_colours(source, sizes);
  return all;
}

// Puts the scores into the record and their picture on disk; throws what goes wrong.
void score_texture(Run& run, const PlannedJob& planned, const JobFiles& files, JobRecord& record) {
  const std::string refusal = scoring_refusal(planned, available_memory());
  if (!refusal.empty()) throw Error("{}", refusal);
  // The texture as others see it: with its file's rounding.
  const Image texture = read_image(files.folder / record.files.front()).image;
  request_of(run, planned.job);  // reads the exemplar again where its files have changed
  if (record.settings.value("/exemplar/hash"_json_pointer, "") != run.loaded->hashes.at(0))
    throw Error("the exemplar has changed since the texture was made");
  if (!run.request.target.mask.empty()) {
    record.metrics["join"] = join_visibility(texture, run.request.target.mask);
    if (tiles_x(run.config.tile)) record.metrics["seam_x"] = seam_visibility(texture, true);
    if (tiles_y(run.config.tile)) record.metrics["seam_y"] = seam_visibility(texture, false);
    return;
  }
  const Scores scores = scores_of(run, planned, texture);
  write_image(files.copy_map, scores.copy_map, {});
  record.copy_map = files.copy_map.lexically_relative(run.options.output).generic_string();
  record.metrics = values_of(scores.values);
  if (run.files.size() > 1) record.map_metrics = map_values(run, planned.job, files, record);
}

}  // namespace

bool lacks_scores(const Run& run, const PlannedJob& planned, const JobRecord& record) {
  return run.config.scores && planned.job.exemplar && record.status == Status::done &&
         record.metrics.empty();
}

bool score_job(Run& run, const PlannedJob& planned, JobRecord& record) {
  const auto start = std::chrono::steady_clock::now();
  const JobFiles files = job_files(run.options.output, planned.name);
  const NothingToKeep scope;
  record.score_error.clear();
  try {
    score_texture(run, planned, files, record);
    record.score_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  } catch (const Interrupted&) {
    return false;
  } catch (const std::bad_alloc&) {
    record.score_error = "out of memory";
  } catch (const std::exception& error) {
    record.score_error = first_line(error.what());
  }
  try {
    write_record(files.record, record);
  } catch (const Error& error) {
    record.score_error = error.what();
  }
  return true;
}

std::vector<NamedRecord> finished_jobs(const Run& run, const JobGroup& jobs) {
  std::vector<NamedRecord> finished;
  for (const PlannedJob* planned : jobs) {
    const JobFiles files = job_files(run.options.output, planned->name);
    // What this run has just written must be there to read.
    std::error_code ignored;
    auto record = planned->selected && std::filesystem::exists(files.record, ignored)
                      ? read_record(files.record)
                      : find_record(files.record);
    if (is_finished(record, files.folder)) finished.push_back({planned->name, std::move(*record)});
  }
  return finished;
}

double diversity_of(Run& run, const Job& job, const std::vector<NamedRecord>& jobs) {
  const int channels = run.plan.exemplars[*job.exemplar].files.front().channels;
  const Cost cost = estimate_diversity(run.config.size, channels, static_cast<int>(jobs.size()));
  const std::string refusal = diversity_refusal(cost, available_memory());
  if (!refusal.empty()) throw Error("{}", refusal);
  std::vector<Image> textures;
  for (const auto& [name, record] : jobs)
    textures.push_back(
        read_image(job_files(run.options.output, name).folder / record.files.at(0)).image);
  return diversity(textures, shown_work(run));
}

}  // namespace gramloom
