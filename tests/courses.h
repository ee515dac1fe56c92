#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/random.h"

namespace gramloom {

/// Bricks in courses that are shifted by half a brick, light joints, each with its own shade.
inline Image wall_of_bricks(Size size, Size brick, float grain) {
  Image wall(size, 3);
  Random random(1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int course = y / brick.height, along = x + course % 2 * brick.width / 2;
      const bool joint = y % brick.height < 3 || along % brick.width < 3;
      const float shade = Random(2, static_cast<std::uint64_t>(course * 1000 + along / brick.width))
                              .uniform(0.25f, 0.45f);
      for (int c = 0; c < 3; ++c)
        wall.at(x, y)[c] = (joint ? 0.8f : shade) + grain * random.uniform();
    }
  return wall;
}

/// Light rows: how often the mean of a row rises above the middle between the darkest and lightest.
inline int light_rows(const Image& image) {
  std::vector<double> means;
  for (int y = 0; y < image.height; ++y) {
    double sum = 0;
    for (int x = 0; x < image.width; ++x) sum += image.at(x, y)[0];
    means.push_back(sum / image.width);
  }
  double low = means[0], high = means[0];
  for (const double mean : means) {
    low = std::min(low, mean);
    high = std::max(high, mean);
  }
  int rows = 0;
  const double middle = (low + high) / 2;
  for (std::size_t y = 0; y < means.size(); ++y)
    rows += means[y] > middle && means[(y + means.size() - 1) % means.size()] <= middle;
  return rows;
}

}  // namespace gramloom
