#include "jobs/job_scores.h"

#include <chrono>
#include <cmath>

#include "jobs/interruption.h"
#include "jobs/memory.h"
#include "metrics/scores.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

Json values_to_json(const Scores& scores) {
  Json json = Json::object();
  for (const auto& [name, value] : scores.values)
    json[std::string(name)] = std::isfinite(value) ? Json(value) : Json();
  return json;
}

// Puts the scores into the record and their picture on disk; throws what goes wrong.
void score_texture(Run& run, const PlannedJob& planned, const JobFiles& files, JobRecord& record) {
  const std::string refusal = scoring_refusal(planned, available_memory());
  if (!refusal.empty()) throw Error("{}", refusal);
  // The texture as others see it: with its file's rounding.
  const Image texture = read_image(files.folder / record.files.front()).image;
  const Scores scores =
      score(statistics_of(run, planned.job), texture, run.config.tile, shown_work(run));
  write_image(files.copy_map, scores.copy_map, {});
  record.copy_map = files.copy_map.lexically_relative(run.options.output).generic_string();
  record.metrics = values_to_json(scores);
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

JobGroup finished_jobs(const Run& run, const JobGroup& jobs) {
  JobGroup finished;
  for (const PlannedJob* planned : jobs) {
    const JobFiles files = job_files(run.options.output, planned->name);
    if (is_finished(read_record(files.record), files.folder)) finished.push_back(planned);
  }
  return finished;
}

double diversity_of(Run& run, const JobGroup& jobs) {
  const Job& first = jobs.front()->job;
  const int channels = run.plan.exemplars[*first.exemplar].files.front().channels;
  const Cost cost = estimate_diversity(run.config.size, channels, static_cast<int>(jobs.size()));
  const std::string refusal = diversity_refusal(cost, available_memory());
  if (!refusal.empty()) throw Error("{}", refusal);
  std::vector<Image> textures;
  for (const PlannedJob* planned : jobs) {
    const JobFiles files = job_files(run.options.output, planned->name);
    const auto record = read_record(files.record);
    if (!record) throw Error("{}: its record is gone", planned->name);
    textures.push_back(read_image(files.folder / record->files.at(0)).image);
  }
  return diversity(textures, shown_work(run));
}

}  // namespace gramloom
