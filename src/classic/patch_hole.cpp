#include "classic/patch_hole.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "classic/patch_vote.h"

namespace gramloom {

namespace {

/// Half the size, rounded up, each pixel the mean of 2×2: the last column and row count twice where
/// they lack a neighbour.
Image halved_up(const Image& image) {
  Image half((image.width + 1) / 2, (image.height + 1) / 2, image.channels);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x) {
      const int right = std::min(2 * x + 1, image.width - 1);
      const int below = std::min(2 * y + 1, image.height - 1);
      const float *a = image.at(2 * x, 2 * y), *b = image.at(right, 2 * y);
      const float *c = image.at(2 * x, below), *d = image.at(right, below);
      for (int k = 0; k < image.channels; ++k)
        half.at(x, y)[k] = ((a[k] + b[k]) + (c[k] + d[k])) / 4;
    }
  return half;
}

HoleLevel halved(const HoleLevel& fine) {
  HoleLevel half;
  half.size = {(fine.size.width + 1) / 2, (fine.size.height + 1) / 2};
  half.states.resize(pixel_count(half.size));
  for (int y = 0; y < fine.size.height; ++y)
    for (int x = 0; x < fine.size.width; ++x) {
      const PixelState state = fine.states[to_size(y) * to_size(fine.size.width) + to_size(x)];
      PixelState& over = half.states[to_size(y / 2) * to_size(half.size.width) + to_size(x / 2)];
      over = std::max(over, state);
    }
  if (!fine.known.empty()) half.known = halved_up(fine.known);
  for (const Image& plane : fine.guide) half.guide.push_back(halved_up(plane));
  if (!fine.guide_weight.empty()) half.guide_weight = halved_up(fine.guide_weight);
  return half;
}

/// First pixel and number of pixels about the holes: those within a patch of them.
struct Part {
  int left, top;
  Size size;
};
Part part_of(const HoleLevel& level, Tile tile) {
  int left = level.size.width, right = -1, top = level.size.height, bottom = -1;
  for (int y = 0; y < level.size.height; ++y)
    for (int x = 0; x < level.size.width; ++x)
      if (level.states[to_size(y) * to_size(level.size.width) + to_size(x)] == PixelState::made) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
  left = tiles_x(tile) ? 0 : std::max(0, left - patch_border);
  right =
      tiles_x(tile) ? level.size.width - 1 : std::min(level.size.width - 1, right + patch_border);
  top = tiles_y(tile) ? 0 : std::max(0, top - patch_border);
  bottom = tiles_y(tile) ? level.size.height - 1
                         : std::min(level.size.height - 1, bottom + patch_border);
  return {left, top, {right - left + 1, bottom - top + 1}};
}

/// A part of a picture, repeated to a canvas's size where it tiles.
Image canvas_of(const Image& image, const Part& part, Size canvas) {
  Image result(canvas, image.channels);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      std::copy_n(image.at(part.left + x % part.size.width, part.top + y % part.size.height),
                  image.channels, result.at(x, y));
  return result;
}

/// How much patches' votes count by the distance of their middle from known pixels: 3^−distance, to
/// 20 pixels. Wexler et al. 2007 (section 3.2) have 1.3^−distance: so much the known pixels
/// outweigh what patches further inside agree on among themselves, and nothing is cut off at the
/// border.
float confidence_at(int distance) {
  float confidence = 1;
  for (int i = 0; i < std::min(distance, 20); ++i) confidence /= 3;
  return confidence;
}

/// Whether any pixel of each patch is made, and how far its middle is from known ones.
std::vector<float> confidences(const std::vector<unsigned char>& made, Size texture, Size field) {
  // Patches on an axis that tiles reach around it.
  const cv::Mat1b holes(texture.height, texture.width, const_cast<unsigned char*>(made.data()));
  cv::Mat1b wide, touched;
  cv::copyMakeBorder(holes, wide, 0, field.height + patch_border - texture.height, 0,
                     field.width + patch_border - texture.width, cv::BORDER_WRAP);
  cv::dilate(wide, touched, cv::Mat::ones(field_patch, field_patch, CV_8U), cv::Point(0, 0));
  cv::Mat1f distance;
  cv::distanceTransform(wide, distance, cv::DIST_C, cv::DIST_MASK_3);
  std::vector<float> result(pixel_count(field));
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x)
      if (touched(y, x) != 0)
        result[to_size(y) * to_size(field.width) + to_size(x)] = confidence_at(
            static_cast<int>(std::min(64.0f, distance(y + field_patch / 2, x + field_patch / 2))));
  return result;
}

/// The mean weight of each patch's pixels.
std::vector<float> patch_weights(const Image& weight, Size field) {
  const cv::Mat1f values(weight.height, weight.width, const_cast<float*>(weight.pixels.data()));
  cv::Mat1f means;
  cv::blur(values, means, {field_patch, field_patch}, {0, 0});
  std::vector<float> result(pixel_count(field));
  for (int y = 0; y < field.height; ++y)
    std::copy_n(means.ptr<float>(y), field.width,
                result.begin() + static_cast<std::ptrdiff_t>(y) * field.width);
  return result;
}

}  // namespace

void make_pyramid(PatchHole& hole) {
  while (static_cast<int>(hole.levels.size()) < hole.window.levels)
    hole.levels.push_back(halved(hole.levels.back()));
}

void enter_level(PatchHole& hole, std::size_t index) {
  const HoleLevel& level = hole.levels[index];
  const Tile tile = hole.window.tile;
  // Growth on the coarsest level looks at all that is known.
  const Part part = index + 1 < hole.levels.size() ? part_of(level, tile) : Part{0, 0, level.size};
  hole.left = part.left;
  hole.top = part.top;
  const Size patches{part.size.width - (tiles_x(tile) ? 0 : patch_border),
                     part.size.height - (tiles_y(tile) ? 0 : patch_border)};
  const Size canvas{patches.width + patch_border, patches.height + patch_border};
  hole.field = blank_field(patches, tile);
  hole.made.assign(pixel_count(part.size), 0);
  for (int y = 0; y < part.size.height; ++y)
    for (int x = 0; x < part.size.width; ++x) {
      const PixelState state =
          level.states[to_size(part.top + y) * to_size(level.size.width) + to_size(part.left + x)];
      // On the finest level no patch touches another window's holes.
      if (state == PixelState::made || (state == PixelState::foreign && index > 0))
        hole.made[to_size(y) * to_size(part.size.width) + to_size(x)] = 1;
    }
  if (level.known.empty()) {
    hole.canvas = Image(canvas, field_features);
  } else {
    hole.canvas = canvas_of(level.known, part, canvas);
    hole.field.confidence = confidences(hole.made, part.size, patches);
  }
  hole.guide = {};
  if (!level.guide.empty()) {
    for (const Image& plane : level.guide)
      hole.guide.wanted.push_back(canvas_of(plane, part, canvas));
    hole.guide_weight = canvas_of(level.guide_weight, part, canvas);
    hole.guide.weight = patch_weights(hole.guide_weight, patches);
  }
}

void refine(PatchHole& hole, std::size_t level, const PatchSource& source) {
  const PatchField coarse = std::move(hole.field);
  const int coarse_left = hole.left, coarse_top = hole.top;
  enter_level(hole, level);
  PatchField& fine = hole.field;
  const Size origins = source.origins();
  for (int y = 0; y < fine.size.height; ++y)
    for (int x = 0; x < fine.size.width; ++x) {
      if (!fine.looks_for(fine.index(x, y))) continue;
      const int u = x + hole.left, v = y + hole.top;
      const int cx = std::clamp(u / 2 - coarse_left, 0, coarse.size.width - 1);
      const int cy = std::clamp(v / 2 - coarse_top, 0, coarse.size.height - 1);
      const PatchOrigin o = coarse.nearest[coarse.index(cx, cy)];
      fine.nearest[fine.index(x, y)] = {
          std::clamp(2 * o.x + u - 2 * (cx + coarse_left), 0, origins.width - 1),
          std::clamp(2 * o.y + v - 2 * (cy + coarse_top), 0, origins.height - 1)};
    }
}

}  // namespace gramloom
