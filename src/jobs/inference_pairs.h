#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "jobs/inputs.h"
#include "jobs/pose_table.h"
#include "learnt/inference_model.h"

namespace gramloom {

/// What an inference learns from: poses and their pictures.
struct InferencePairs {
  std::vector<PoseNumber> numbers;  // of a pose, with their ranges
  std::vector<std::vector<double>> poses;
  std::vector<Image> pictures;  // of one size and number of channels
  PixelType pixel_type = PixelType::uint8;
  MapKind values = MapKind::scalar;
  std::string hash;  // of the table and all pictures
};

/// Throws Error when a table has no column 'picture', or fewer than `fewest_pairs`.
void check_pairs(const PoseTable& table, const std::filesystem::path& file);
/// Throws Error where one of the table's pictures is none, or its sides are not those of the first
/// one, by the files' headers: before anything long begins. What only pixels show is not looked at.
void check_pictures(const PoseTable& table, const std::filesystem::path& file);
inline constexpr std::size_t fewest_pairs = 8;

/// The pairs of a table with a column 'picture', a file each, from the table's folder on. Throws
/// Error likewise, and for a picture that cannot be read or is of another size or number of
/// channels than the first, and for fewer than `fewest_pairs`.
InferencePairs read_pairs(const std::filesystem::path& table, FileHashes& hashes);

/// Which pairs are trained on; by which the best state is chosen; and which only tell the error.
struct PairSplit {
  std::vector<std::size_t> learnt, chosen_by, tested;
};
/// `share` of `count` pairs are held out, spread evenly over the table by the seed, and take turns
/// in the latter two.
PairSplit split_pairs(std::size_t count, double share, int seed);

/// The numbers of a pose, with their ranges in the poses that are trained on. The table has
/// `fewest_pairs`.
std::vector<PoseNumber> learnt_numbers(const PoseTable& table, const PairSplit& split);

/// Those of the pairs.
InferencePairs select_pairs(const InferencePairs& pairs, const std::vector<std::size_t>& wanted);

}  // namespace gramloom
