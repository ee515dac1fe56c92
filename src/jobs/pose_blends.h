#pragma once

#include <string>
#include <vector>

#include "jobs/inference_pairs.h"

namespace gramloom {

// What an inference is measured against: pictures of a pose that are sums of pictures of others.

/// Weights fall with the distance of poses, each number relative to its range.
struct PoseBlend {
  int neighbours = 1;
  double power = 2;     // of the inverse distance
  bool linear = false;  // weights of a linear fit to the neighbours (locally weighted regression)

  std::string text() const;
};

/// The picture of the nearest pose of the pairs.
const Image& nearest_picture(const InferencePairs& pairs, const std::vector<double>& pose);

/// The blend of the nearest pairs.
Image blended_picture(const InferencePairs& pairs, const PoseBlend& blend,
                      const std::vector<double>& pose);

/// The mean of pictures.
Image mean_picture(const std::vector<Image>& pictures);

/// The root of the mean square of made − true, relative to that of mean − true.
double relative_error(const std::vector<Image>& made, const std::vector<Image>& real,
                      const Image& mean);

/// Of many blends of `pairs` the one that is best on `others`.
PoseBlend best_blend(const InferencePairs& pairs, const InferencePairs& others);

}  // namespace gramloom
