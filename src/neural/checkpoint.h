#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "neural/optimise/optimiser.h"

namespace gramloom::neural {

/// How far an unfinished synthesis is: enough to go on to the same bytes as if it had not stopped.
struct Checkpoint {
  std::string fingerprint;     // of everything that the result depends on
  int level = 0;               // of the pyramid, 0 is the finest
  int first_level = 0;         // on which the present picture began as noise
  std::int64_t iteration = 0;  // done on this level
  std::int64_t evaluations = 0;
  double seconds = 0;
  double first_loss = 0;  // of this level
  at::Tensor picture;     // (channels, height, width)
  SavedState optimiser;
};

/// Complete or not at all. Throws Error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Nothing when there is no file, or it belongs to another synthesis, or is damaged: then the work
/// begins anew.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file,
                                          const std::string& fingerprint);

}  // namespace gramloom::neural
