#pragma once

#include <vector>

#include "core/cost.h"
#include "jobs/lesson_run.h"

namespace gramloom {

/// Trains a generator. Throws Error for exemplars that it cannot learn, ConfigError for a recipe
/// that they don't allow, Interrupted.
void train_generator_lesson(const LessonRun& run);

/// What training it is expected to need. Throws as the training does.
Cost estimate_generator_lesson(const Config& config, const Lesson& lesson);

/// Its textures, to be run and scored: a method for every exemplar that it has learnt.
std::vector<MethodEntry> methods_of_generator(const Config& config, const Lesson& lesson,
                                              const JobFiles& files);

}  // namespace gramloom
