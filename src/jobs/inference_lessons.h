#pragma once

#include "core/cost.h"
#include "jobs/lesson_run.h"

namespace gramloom {

/// Throws ConfigError for a sequence whose poses are not the table's, or outside the ranges that
/// are going to be learnt; whatever else is wrong with a table is for the training to tell.
void check_frames(const ModelEntry& model);

/// Throws Error when a frame would replace one of `inputs`, or a file that is no inferred picture.
void check_frame_files(const ModelEntry& model, const JobFiles& files,
                       const ProtectedFiles& inputs);

/// What training it is expected to need, with its simulation and its sequence. Throws as the
/// training does for a table, its first picture, a simulation or a recipe that is wrong.
Cost estimate_inference_lesson(const ModelEntry& model);

/// Trains an inference on the pairs of its table, or of its simulation, whose pictures are made
/// first unless the run resumes and finds them; then makes its sequence. Throws Error for pairs
/// that it cannot learn, ConfigError for a recipe or simulation that is wrong, Interrupted.
void train_inference_lesson(const LessonRun& run);

}  // namespace gramloom
