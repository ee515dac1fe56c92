#include "classic/patch_windows.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "signal/patch_origin.h"

namespace gramloom {

namespace {

/// Part of an axis; one that tiles may be reached around.
struct Interval {
  int first = 0, length = 0;
};

/// Holes near each other.
struct Group {
  int left, right, top, bottom;  // first and last pixel, where it does not reach around
  bool around_x = false, around_y = false;
  int width = 0;  // twice the largest distance from known pixels
};

cv::Mat1b holes_of(const Image& mask) {
  cv::Mat1b holes(mask.height, mask.width);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) holes(y, x) = *mask.at(x, y) > 0.5f ? 1 : 0;
  return holes;
}

/// Which group each pixel near a hole is of, from 1 on; joined across edges that tile.
class Labels {
 public:
  Labels(const cv::Mat1b& holes, Tile tile) {
    cv::Mat1b near;
    constexpr int side = 2 * field_patch + 1;
    cv::dilate(holes, near, cv::Mat::ones(side, side, CV_8U));
    parents_.resize(to_size(cv::connectedComponents(near, labels_)));
    std::iota(parents_.begin(), parents_.end(), 0);
    const int right = near.cols - 1, bottom = near.rows - 1;
    for (int y = 0; tiles_x(tile) && y < near.rows; ++y) join(labels_(y, 0), labels_(y, right));
    for (int x = 0; tiles_y(tile) && x < near.cols; ++x) join(labels_(0, x), labels_(bottom, x));
    for (int& parent : parents_) parent = root(parent);
  }
  int count() const { return static_cast<int>(parents_.size()); }
  int at(int x, int y) const { return parents_[to_size(labels_(y, x))]; }

 private:
  int root(int label) const {
    while (parents_[to_size(label)] != label) label = parents_[to_size(label)];
    return label;
  }
  void join(int a, int b) {
    if (a == 0 || b == 0) return;
    a = root(a), b = root(b);
    parents_[to_size(std::max(a, b))] = std::min(a, b);
  }

  cv::Mat1i labels_;
  std::vector<int> parents_;
};

std::vector<Group> groups_of(const cv::Mat1b& holes, const Labels& labels, Tile tile) {
  std::vector<Group> groups(to_size(labels.count()), {holes.cols, -1, holes.rows, -1});
  cv::Mat1f distance;
  cv::distanceTransform(holes, distance, cv::DIST_C, cv::DIST_MASK_3);
  const auto widest = static_cast<float>(std::max(holes.cols, holes.rows));
  for (int y = 0; y < holes.rows; ++y)
    for (int x = 0; x < holes.cols; ++x) {
      if (holes(y, x) == 0) continue;
      Group& group = groups[to_size(labels.at(x, y))];
      group.left = std::min(group.left, x);
      group.right = std::max(group.right, x);
      group.top = std::min(group.top, y);
      group.bottom = std::max(group.bottom, y);
      const float width = std::min(widest, 2 * distance(y, x) - 1);
      group.width = std::max(group.width, static_cast<int>(width));
    }
  // A group may reach around where its neighbourhood does.
  for (int y = 0; tiles_x(tile) && y < holes.rows; ++y)
    groups[to_size(labels.at(0, y))].around_x = true;
  for (int x = 0; tiles_y(tile) && x < holes.cols; ++x)
    groups[to_size(labels.at(x, 0))].around_y = true;
  return groups;
}

/// What lies around the largest gap of an axis that is reached around.
Interval around_gap(const std::vector<char>& used) {
  const int length = static_cast<int>(used.size());
  int best_first = 0, best = 0, run = 0;
  for (int i = 0; i < 2 * length; ++i) {
    run = used[to_size(i % length)] ? 0 : run + 1;
    if (run > best && run < length) {
      best = run;
      best_first = i - run + 1;
    }
  }
  return {(best_first + best) % length, length - best};
}

/// With a margin, which ends at edges that do not tile, from a multiple of `grid` on.
Interval grown(Interval hole, int margin, int grid, int length, bool tiles) {
  if (tiles && hole.length + 2 * margin + grid >= length) return {0, length};
  const int first = (hole.first - margin + (tiles ? length : 0)) / grid * grid;
  const int end = hole.first + hole.length + margin + (tiles ? length : 0);
  if (tiles) return {first % length, end - first};
  return {std::max(0, first), std::min(length, end) - std::max(0, first)};
}

PatchWindow window_of(const Group& group, int label, const Labels& labels, const cv::Mat1b& holes,
                      Tile tile, int levels) {
  Interval x{group.left, group.right - group.left + 1};
  Interval y{group.top, group.bottom - group.top + 1};
  if (group.around_x || group.around_y) {
    std::vector<char> columns(to_size(holes.cols)), rows(to_size(holes.rows));
    for (int v = 0; v < holes.rows; ++v)
      for (int u = 0; u < holes.cols; ++u)
        if (holes(v, u) != 0 && labels.at(u, v) == label)
          columns[to_size(u)] = rows[to_size(v)] = 1;
    if (group.around_x) x = around_gap(columns);
    if (group.around_y) y = around_gap(rows);
  }
  // A patch more on the coarsest level, and what the features of its last pixels look at.
  const int margin = (field_patch << (levels - 1)) + field_patch;
  // Its coarse pixels are those of the whole picture, which an exemplar of the same size has, too.
  const int grid = 1 << (levels - 1);
  x = grown(x, margin, grid, holes.cols, tiles_x(tile));
  y = grown(y, margin, grid, holes.rows, tiles_y(tile));
  return {
      x.first,
      y.first,
      {x.length, y.length},
      wrapping(tiles_x(tile) && x.length == holes.cols, tiles_y(tile) && y.length == holes.rows),
      levels,
      {}};
}

}  // namespace

PatchWindow whole_window(Size target, Tile tile, int levels) {
  return {
      0,
      0,
      target,
      tile,
      levels,
      std::vector<PixelState>(to_size(target.width) * to_size(target.height), PixelState::made)};
}

std::vector<PatchWindow> windows_of(const Image& mask, Tile tile,
                                    const std::function<int(int width)>& levels_for) {
  const cv::Mat1b holes = holes_of(mask);
  const Labels labels(holes, tile);
  const std::vector<Group> groups = groups_of(holes, labels, tile);
  std::vector<PatchWindow> windows;
  std::vector<int> label_of;
  double area = 0;
  int levels = 1;
  for (int label = 1; label < labels.count(); ++label) {
    const Group& group = groups[to_size(label)];
    if (group.right < 0) continue;  // joined to another
    windows.push_back(window_of(group, label, labels, holes, tile, levels_for(group.width)));
    label_of.push_back(label);
    levels = std::max(levels, windows.back().levels);
    area += static_cast<double>(windows.back().size.width) * windows.back().size.height;
  }
  const bool as_one = area > 2.0 * mask.width * mask.height;
  if (as_one) windows = {{0, 0, mask.size(), tile, levels, {}}};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    PatchWindow& window = windows[i];
    window.states.resize(to_size(window.size.width) * to_size(window.size.height));
    auto state = window.states.begin();
    for (int y = 0; y < window.size.height; ++y)
      for (int x = 0; x < window.size.width; ++x, ++state) {
        const int u = (window.left + x) % mask.width, v = (window.top + y) % mask.height;
        if (holes(v, u) != 0)
          *state =
              as_one || labels.at(u, v) == label_of[i] ? PixelState::made : PixelState::foreign;
      }
  }
  return windows;
}

}  // namespace gramloom
