#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "metrics/scores.h"

namespace gramloom {

/// One picture's scores, under the name that the user gave it, or why it has none.
struct ScoredImage {
  std::string name;
  Scores scores;
  std::string error = "";  // with the name of the file
};

/// The scores of picture files against an exemplar's, and with `controls` those of pictures with
/// known faults made from it. `tile`: the axes on which the pictures claim to tile.
/// A picture that cannot be read or compared does not stop the others. Throws Error for the
/// exemplar.
std::vector<ScoredImage> score_files(const std::filesystem::path& exemplar,
                                     const std::vector<std::string>& images, Tile tile,
                                     bool controls, const Control& control);

/// A row for each score, a column for each picture that has any.
std::string score_table(const std::vector<ScoredImage>& scored);
/// {"picture": {"score": value, …}, …}
std::string score_json(const std::vector<ScoredImage>& scored);

}  // namespace gramloom
