#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/fields.h"
#include "neural/flow/patch_flow.h"
#include "neural/optimise/optimiser.h"

namespace gramloom::neural {

/// How far an unfinished synthesis is: enough to go on to the same bytes as if it had not stopped.
/// It lies in one safetensors file: pictures as tensors, numbers as texts of its metadata, exact.
struct Checkpoint {
  std::string identity;  // whose it is: core/progress.h
  int level = 0;
  int first_level = 0;
  std::int64_t iteration = 0;
  std::int64_t evaluations = 0;
  double seconds = 0;
  double first_loss = 0;
  std::int64_t layout_step = 0;
  at::Tensor prices, sources;  // of the layout; undefined: none
  at::Tensor nearest;          // of a fill, on this level (loss/directed_places.h); likewise
  at::Tensor picture;          // (channels, height, width)
  SavedState optimiser;

  static constexpr auto fields() {
    using C = Checkpoint;
    return std::tuple{
        Field{"level", &C::level, "of the pyramid, 0 is the finest"},
        Field{"first_level", &C::first_level, "on which the present picture began as noise"},
        Field{"iteration", &C::iteration, "steps done on this level"},
        Field{"evaluations", &C::evaluations, "of the loss, on all levels"},
        Field{"seconds", &C::seconds, "since the start", "seconds"},
        Field{"first_loss", &C::first_loss, "of this level"},
        Field{"layout_step", &C::layout_step, "steps of the layout done on this level"}};
  }
};

/// Complete or not at all. Throws Error.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Nothing when there is no file, or it has another identity, or is damaged: then the work begins
/// anew.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& file,
                                          const std::string& identity);

}  // namespace gramloom::neural
