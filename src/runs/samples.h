#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gramloom {

/// A picture that a training shows of itself: NAME_000200.png after so many steps, or
/// NAME_held_out.png, of pairs that it has not seen.
struct Sample {
  std::filesystem::path file;
  std::optional<int> step;  // none: held out
};

/// Those of the model `name` in `folder`, by their steps; what was held out comes last.
std::vector<Sample> samples_in(const std::filesystem::path& folder, const std::string& name);

}  // namespace gramloom
