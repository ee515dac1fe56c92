#pragma once

#include "jobs/lesson_run.h"

namespace gramloom {

/// Trains an inference on the pairs of its table, or of its simulation, whose pictures are made
/// first unless the run resumes and finds them. Throws Error for pairs that it cannot learn,
/// ConfigError for a recipe or simulation that is wrong, Interrupted.
void train_inference_lesson(const LessonRun& run);

}  // namespace gramloom
