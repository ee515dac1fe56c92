#include "jobs/inference_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/random.h"
#include "jobs/map_file.h"
#include "jobs/memory.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// With the range that each has in these poses.
std::vector<PoseNumber> numbers_of(const std::vector<std::string>& names,
                                   const std::vector<std::vector<double>>& poses) {
  std::vector<PoseNumber> numbers;
  for (std::size_t k = 0; k < names.size(); ++k) {
    PoseNumber& number = numbers.emplace_back(names[k], poses.front()[k], poses.front()[k]);
    for (const auto& pose : poses) {
      number.low = std::min(number.low, pose[k]);
      number.high = std::max(number.high, pose[k]);
    }
  }
  return numbers;
}

Image read_picture(const fs::path& file, InferencePairs& pairs) {
  ImageFile read = read_image(file);
  if (pairs.pictures.empty()) {
    pairs.pixel_type = read.encoding.pixel_type;
    pairs.values = kind_of_map("", {file, {}, {}}, read.image);
    return std::move(read.image);
  }
  const Image& first = pairs.pictures.front();
  if (read.image.size() != first.size() || read.image.channels != first.channels)
    throw Error("{} is of {}×{} with {} channels, the first picture of {}×{} with {}",
                file.string(), read.image.width, read.image.height, read.image.channels,
                first.width, first.height, first.channels);
  return std::move(read.image);
}

}  // namespace

void check_pairs(const PoseTable& table, const fs::path& file) {
  const std::size_t count = table.poses.size();
  if (table.pictures.empty() && count > 0)
    throw Error("{}: has no column '{}'", place_in(file, 1), picture_column);
  if (count < fewest_pairs)
    throw Error("{}: has {} pairs, needed are {} at least", file.string(), count, fewest_pairs);
}

void check_pictures(const PoseTable& table, const fs::path& file) {
  Size first;
  for (std::size_t i = 0; i < table.pictures.size(); ++i) {
    const fs::path picture = file.parent_path() / table.pictures[i];
    try {
      Size size = read_image_size(picture);
      if (size.width > size.height) std::swap(size.width, size.height);  // EXIF may turn it yet
      if (i == 0) first = size;
      if (size != first)
        throw Error("{} has sides of {} and {}, the first picture of {} and {}", picture.string(),
                    size.width, size.height, first.width, first.height);
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, table.lines[i]), error.what());
    }
  }
}

InferencePairs read_pairs(const fs::path& file, FileHashes& hashes) {
  PoseTable table = read_pose_table(file);
  check_pairs(table, file);
  const std::size_t count = table.poses.size();
  InferencePairs pairs;
  std::string all = hashes.of(file);
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path picture = file.parent_path() / table.pictures[i];
    try {
      pairs.pictures.push_back(read_picture(picture, pairs));
    } catch (const Error& error) {
      throw Error("{}: {}", place_in(file, table.lines[i]), error.what());
    }
    all += hashes.of(picture);
    // Twice: as they are, and as they are trained on.
    const double bytes =
        8.0 * static_cast<double>(count) * static_cast<double>(pairs.pictures[0].pixels.size());
    if (i == 0 && bytes > available_memory())
      throw Error("{}: {} pictures need about {:.1f} GB of memory, {:.1f} GB are free",
                  file.string(), count, bytes / 1e9, available_memory() / 1e9);
  }
  pairs.numbers = numbers_of(table.names, table.poses);
  pairs.poses = std::move(table.poses);
  pairs.hash = hash_of(all);
  return pairs;
}

PairSplit split_pairs(std::size_t count, double share, int seed) {
  const auto wanted = static_cast<std::size_t>(std::lround(share * static_cast<double>(count)));
  const std::size_t held_out = std::clamp<std::size_t>(wanted, 2, count / 2);
  Random random(static_cast<std::uint64_t>(seed));
  PairSplit split;
  std::size_t next = 0;
  for (std::size_t i = 0; i < held_out; ++i) {
    const std::size_t first = i * count / held_out, end = (i + 1) * count / held_out;
    const std::size_t chosen = first + random.below(static_cast<std::uint32_t>(end - first));
    for (; next < end; ++next)
      if (next != chosen) split.learnt.push_back(next);
    (i % 2 == 0 ? split.chosen_by : split.tested).push_back(chosen);
  }
  return split;
}

std::vector<PoseNumber> learnt_numbers(const PoseTable& table, const PairSplit& split) {
  std::vector<std::vector<double>> learnt;
  for (const std::size_t i : split.learnt) learnt.push_back(table.poses[i]);
  return numbers_of(table.names, learnt);
}

InferencePairs select_pairs(const InferencePairs& pairs, const std::vector<std::size_t>& wanted) {
  InferencePairs some{pairs.numbers, {}, {}, pairs.pixel_type, pairs.values, pairs.hash};
  for (const std::size_t i : wanted) {
    some.poses.push_back(pairs.poses[i]);
    some.pictures.push_back(pairs.pictures[i]);
  }
  std::vector<std::string> names;
  for (const PoseNumber& number : pairs.numbers) names.push_back(number.name);
  some.numbers = numbers_of(names, some.poses);
  return some;
}

}  // namespace gramloom
