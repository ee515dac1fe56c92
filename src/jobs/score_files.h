#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "metrics/scores.h"

namespace gramloom {

/// One picture's scores, under the name that the user gave it.
struct ScoredImage {
  std::string name;
  Scores scores;
};

/// The scores of picture files against an exemplar's, and with `controls` those of pictures with
/// known faults made from it. `tile`: the axes on which the pictures claim to tile.
/// Throws Error with the path of a file that cannot be read or compared.
std::vector<ScoredImage> score_files(const std::filesystem::path& exemplar,
                                     const std::vector<std::string>& images, Tile tile,
                                     bool controls, const Control& control);

/// A row for each score, a column for each picture.
std::string score_table(const std::vector<ScoredImage>& scored);
/// {"picture": {"score": value, …}, …}
std::string score_json(const std::vector<ScoredImage>& scored);

}  // namespace gramloom
