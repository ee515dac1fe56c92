#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "jobs/config.h"
#include "jobs/exemplar.h"

namespace gramloom {

/// One texture to make, as indices into a Config; no exemplar for a method that needs none.
struct Job {
  std::optional<std::size_t> exemplar;
  std::size_t method = 0;
  int seed = 0;
};

/// The exemplar's name, or that of the folder for methods that need none.
std::string exemplar_name(const Config& config, const Job& job);
/// "pebbles/quilting", "procedural/marble": the job's folder in the output folder.
std::string job_folder(const Config& config, const Job& job);
/// "pebbles/quilting/seed1": the job's name, and its files without their extension.
std::string job_name(const Config& config, const Job& job);

/// Whether "exemplar/method/seedN", or its "exemplar/method", matches a pattern (see pattern.h); an
/// empty pattern matches all.
bool job_matches(const std::string& pattern, const std::string& job);

/// What is known of an exemplar before its jobs run.
struct ExemplarFacts {
  bool known = false;   // false: nothing has looked yet
  RequestSize request;  // of its jobs; exemplars after max_side
  std::vector<ExemplarFile> files;
  std::string error;  // why it cannot be read, or taken by a method; its jobs fail with this
};

/// A job and what it is expected to need.
struct PlannedJob {
  Job job;
  std::string name;
  Cost cost;             // of making the texture
  Cost finishing;        // of its file, and of the maps and the preview that are made of it
  Cost scoring;          // of scoring it afterwards; 0: it will not be
  std::string error;     // why it cannot run; empty when it can
  bool selected = true;  // false: --only leaves it out
};

/// The comparison of the selected seeds of one exemplar and method.
struct PlannedDiversity {
  std::string name;  // "pebbles/quilting"
  Cost cost;
};

/// All jobs of a config and what is known before they run.
struct Plan {
  std::vector<ExemplarFacts> exemplars;  // as in the config
  std::vector<PlannedJob> jobs;
  std::vector<PlannedDiversity> diversities;
};

/// The jobs of a config, of which nothing is known. Selected are those that match `only` (see
/// job_matches). Throws ConfigError when there are jobs and none matches, in a config that trains
/// no models, which may be what is meant.
Plan list_jobs(const Config& config, const std::string& only = "");

/// Reads the exemplar of the plan's job of this number, unless it is known, and estimates the job.
/// Throws ConfigError as make_plan() does.
void plan_job(const Config& config, Plan& plan, std::size_t number);

/// list_jobs(), and then reads every exemplar once and estimates every job. All that keeps a job
/// from running, but for the memory that is free, is found here, for `check` and for `run`: what is
/// wrong with its exemplar, what the method refuses, what the files of the results cannot hold.
/// Throws ConfigError for parameters that a method refuses, for maps that do not fit their picture,
/// and where list_jobs() does.
Plan make_plan(const Config& config, const std::string& only = "");
/// Whether any of its jobs is to be done.
bool has_selected(const Plan& plan);

/// "" when a finished texture can be scored in `available` bytes; otherwise why not.
std::string scoring_refusal(const PlannedJob& job, double available);

/// "" when finished textures can be compared in `available` bytes; otherwise why not.
std::string diversity_refusal(const Cost& cost, double available);

/// "" when the job fits into `available` bytes; otherwise one line that says what would fit.
std::string memory_refusal(const Config& config, const Plan& plan, const PlannedJob& job,
                           double available);

}  // namespace gramloom
