#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/config.h"
#include "jobs/expectation.h"
#include "jobs/lessons.h"
#include "jobs/progress_bar.h"
#include "jobs/runner.h"

namespace gramloom {

/// The models that a config trains, of those that match `only`, with what each is expected to need.
/// Throws ConfigError for a sequence of poses outside what would be learnt.
std::vector<Expectation> expected_lessons(const Config& config, const std::string& only);

/// How trainings went, and what became of them: of generators a method each for every exemplar it
/// has learnt, to be run and scored against it.
struct Trained {
  int failed = 0;
  bool interrupted = false;
  std::vector<MethodEntry> methods;
};

/// Trains the models of a config one after another and leaves in `output`/models:
///   NAME.safetensors          the model, its best state by a score that training does not see
///   NAME.csv                  the trace of its losses
///   NAME_000200.png           what it makes after 200 steps, and so on
///   NAME_held_out.png         of an inference, beside the truth, the nearest pair and a blend
///   NAME_frames               the folder of its sequence, as `infer` writes it
///   NAME.checkpoint[.csv]     state of an unfinished training
/// and in `output`/data/NAME the pictures that were simulated for an inference.
/// With `options.resume`, finished ones are kept, and unfinished ones go on to the same bytes. One
/// that fails does not stop the others. Throws ConfigError when none matches `options.only`, when
/// `output` cannot be written, or when a file in it that would be replaced is no run's, and for a
/// sequence of poses outside what would be learnt.
Trained train_models(const Config& config, const RunOptions& options, ProgressBar& bar);

/// The methods of all models that a config trains into `output`, as if they were there.
std::vector<MethodEntry> trained_methods(const Config& config, const std::filesystem::path& output);

/// The run that follows, as any: of the textures of what was trained, with those of the config's
/// methods beside them. None when there is nothing to make.
std::optional<Config> textures_of_trained(Config config, const Trained& trained,
                                          const std::string& only);

}  // namespace gramloom
