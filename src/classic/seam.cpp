#include "classic/seam.h"

#include <algorithm>

namespace gramloom {

namespace {

/// The pixel `along` a side and `depth` pixels in from it.
struct Side {
  bool vertical;  // left or right
  bool far;       // right or bottom
  int depth;      // of the filled strip

  int length(Size patch) const { return vertical ? patch.height : patch.width; }
  int x(int along, int in, Size patch) const {
    return !vertical ? along : far ? patch.width - 1 - in : in;
  }
  int y(int along, int in, Size patch) const {
    return vertical ? along : far ? patch.height - 1 - in : in;
  }
};

float squared_difference(const Image& a, const Image& b, int x, int y) {
  float sum = 0;
  for (int c = 0; c < a.channels; ++c) {
    const float d = a.at(x, y)[c] - b.at(x, y)[c];
    sum += d * d;
  }
  return sum;
}

}  // namespace

std::vector<int> minimum_cut(const std::vector<float>& errors, int length, int width) {
  std::vector<float> cost(errors);  // of the best path from row 0 to here
  const auto best_of_three = [&](int row, int column) {
    const float* above = cost.data() + to_size(row) * to_size(width);
    int best = std::max(0, column - 1);
    for (int c = best + 1; c <= std::min(width - 1, column + 1); ++c)
      if (above[c] < above[best]) best = c;
    return best;
  };
  for (int row = 1; row < length; ++row)
    for (int column = 0; column < width; ++column)
      cost[to_size(row * width + column)] +=
          cost[to_size((row - 1) * width + best_of_three(row - 1, column))];
  std::vector<int> path(to_size(length));
  const auto last = cost.end() - width;
  path.back() = static_cast<int>(std::min_element(last, cost.end()) - last);
  for (int row = length - 2; row >= 0; --row)
    path[to_size(row)] = best_of_three(row, path[to_size(row + 1)]);
  return path;
}

PatchCut cut(const Image& old, const Image& fresh, const Sides& sides) {
  const Size patch = old.size();
  PatchCut result{std::vector<unsigned char>(to_size(patch.width * patch.height), 1)};
  for (const Side side : {Side{true, false, sides.left}, Side{true, true, sides.right},
                          Side{false, false, sides.top}, Side{false, true, sides.bottom}}) {
    if (side.depth == 0) continue;
    const int length = side.length(patch);
    std::vector<float> errors(to_size(length * side.depth));
    for (int along = 0; along < length; ++along)
      for (int in = 0; in < side.depth; ++in)
        errors[to_size(along * side.depth + in)] =
            squared_difference(old, fresh, side.x(along, in, patch), side.y(along, in, patch));
    const std::vector<int> path = minimum_cut(errors, length, side.depth);
    for (int along = 0; along < length; ++along) {
      const int depth = path[to_size(along)];
      result.error += double{errors[to_size(along * side.depth + depth)]};
      for (int in = 0; in < depth; ++in)
        result.mask[to_size(side.y(along, in, patch) * patch.width + side.x(along, in, patch))] = 0;
    }
  }
  return result;
}

std::vector<float> feathered(const std::vector<unsigned char>& mask, Size patch, const Sides& sides,
                             int radius) {
  const auto at = [&](int x, int y) {
    if ((x < 0 && sides.left > 0) || (x >= patch.width && sides.right > 0) ||
        (y < 0 && sides.top > 0) || (y >= patch.height && sides.bottom > 0))
      return 0;
    return int{mask[to_size(std::clamp(y, 0, patch.height - 1) * patch.width +
                            std::clamp(x, 0, patch.width - 1))]};
  };
  std::vector<float> weights(mask.begin(), mask.end());
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x) {
      if (!sides.covers(x, y, patch)) continue;
      int sum = 0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) sum += at(x + dx, y + dy);
      const int area = (2 * radius + 1) * (2 * radius + 1);
      weights[to_size(y * patch.width + x)] = static_cast<float>(sum) / static_cast<float>(area);
    }
  return weights;
}

}  // namespace gramloom
