#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/cost.h"
#include "core/progress.h"
#include "jobs/inputs.h"
#include "jobs/protected_files.h"
#include "jobs/training.h"
#include "runs/job_files.h"

namespace gramloom {

// What the trainings of all kinds of models share.

/// A lesson that is to be trained now.
struct LessonRun {
  const Config& config;
  const Lesson& lesson;
  const RunOptions& options;
  ProgressBar& bar;
  const JobFiles& files;
  FileHashes& hashes;
};

/// A lesson's model.
std::filesystem::path model_of(const JobFiles& files);

/// Whether the run resumes and finds its model finished, by its `identity`: then it says so.
bool is_trained_before(const LessonRun& run, const std::string& identity);

/// Throws Error when more memory is needed than there is; `advice`: what needs less.
void refuse_without_memory(const Cost& cost, std::string_view advice);

/// Trains with a trace and a checkpoint, from which it goes on when the run resumes. `train` leaves
/// the finished model. Returns the seconds of all attempts. Throws Interrupted.
double run_training(const LessonRun& run, const std::string& identity,
                    const std::function<void(const Control&)>& train);

/// Throws Error when training would write over one of `inputs`, or replace a file that no training
/// made.
void check_outputs(const JobFiles& files, const ProtectedFiles& inputs);

}  // namespace gramloom
