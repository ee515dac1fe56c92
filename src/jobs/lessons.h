#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jobs/config.h"

namespace gramloom {

/// A model to train: a [[model]] of the config. A generator is of one exemplar, or of several to
/// blend; an inference of none.
struct Lesson {
  std::size_t model = 0;               // of the config
  std::vector<std::size_t> exemplars;  // of the config
  std::string name;                    // of its files: "pebbles_stones", or the model's for a blend
};
/// Those that match `only` (job_matches()) as the jobs of their textures do, EXEMPLAR/MODEL; an
/// inference has its own name.
std::vector<Lesson> lessons_of(const Config& config, const std::string& only = "");

/// Their names as `only` means them, one for each exemplar of a blend.
std::vector<std::string> lesson_names(const Config& config);

bool is_inference(const Config& config, const Lesson& lesson);

/// Throws ConfigError when two lessons would have the same files, or a name is too long for one.
void check_lesson_names(const Config& config);

}  // namespace gramloom
