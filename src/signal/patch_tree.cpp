#include "signal/patch_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "signal/patch_field.h"

namespace gramloom {

namespace {

constexpr std::int64_t leaf_patches = 16;

/// Means over 4×4 pixels of one component within a patch: nine of the first, and the middle of the
/// next two.
struct Box {
  int x, y, component;
};
constexpr std::array<Box, 11> boxes{{{0, 0, 0},
                                     {2, 0, 0},
                                     {4, 0, 0},
                                     {0, 2, 0},
                                     {2, 2, 0},
                                     {4, 2, 0},
                                     {0, 4, 0},
                                     {2, 4, 0},
                                     {4, 4, 0},
                                     {2, 2, 1},
                                     {2, 2, 2}}};

float value_in(const Image& means, PatchOrigin patch, const Box& box) {
  return means.at(patch.x + box.x, patch.y + box.y)[box.component];
}

}  // namespace

Image box_means(const Image& image) {
  Image result(image.size(), image.channels);
  const cv::Mat in(image.height, image.width, CV_32FC(field_features),
                   const_cast<float*>(image.pixels.data()));
  cv::Mat out(image.height, image.width, CV_32FC(field_features), result.pixels.data());
  cv::blur(in, out, {4, 4}, {0, 0}, cv::BORDER_REFLECT);
  return result;
}

PatchTree::PatchTree(const Image& exemplar) : origins_(patch_origins(exemplar.size())) {
  const std::int64_t count = std::int64_t{origins_.width} * origins_.height;
  while (leaves_ * leaf_patches < count) leaves_ *= 2;
  patches_.resize(static_cast<std::size_t>(count));
  std::iota(patches_.begin(), patches_.end(), 0);
  nodes_.resize(static_cast<std::size_t>(leaves_ - 1));
  split(box_means(exemplar), 0, 0, leaves_);
}

std::int64_t PatchTree::leaf(const Image& means, int x, int y) const {
  std::int64_t node = 0;
  while (node < leaves_ - 1) {
    const Node& n = nodes_[static_cast<std::size_t>(node)];
    const Box& box = boxes[n.box];
    const bool below = means.at(x + box.x, y + box.y)[box.component] < n.value;
    node = 2 * node + (below ? 1 : 2);
  }
  return node - (leaves_ - 1);
}

/// The box that varies most among up to 64 of the patches.
std::size_t PatchTree::widest_box(const Image& means, std::int64_t begin, std::int64_t end) const {
  const std::int64_t step = std::max<std::int64_t>(1, (end - begin) / 64);
  std::size_t best = 0;
  double most = -1;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    double sum = 0, squares = 0, n = 0;
    for (std::int64_t i = begin; i < end; i += step, ++n) {
      const double v = double{value_in(means, origin(i), boxes[b])};
      sum += v;
      squares += v * v;
    }
    const double variance = squares / n - sum * sum / (n * n);
    if (variance > most) {
      most = variance;
      best = b;
    }
  }
  return best;
}

void PatchTree::split(const Image& means, std::int64_t node, std::int64_t first_leaf,
                      std::int64_t last_leaf) {
  if (last_leaf - first_leaf == 1) return;
  const std::int64_t middle_leaf = (first_leaf + last_leaf) / 2;
  const std::int64_t begin = first_of(first_leaf), end = first_of(last_leaf);
  const std::int64_t middle = first_of(middle_leaf);
  Node& n = nodes_[static_cast<std::size_t>(node)];
  n.box = widest_box(means, begin, end);
  const Box& box = boxes[n.box];
  const auto value = [&](int patch) {
    return value_in(means, {patch % origins_.width, patch / origins_.width}, box);
  };
  if (middle < end) {
    // By place where values are equal, so that the order is the same with any library.
    std::nth_element(patches_.begin() + begin, patches_.begin() + middle, patches_.begin() + end,
                     [&](int a, int b) {
                       const float u = value(a), v = value(b);
                       return u != v ? u < v : a < b;
                     });
    n.value = value(patches_[static_cast<std::size_t>(middle)]);
  }
  split(means, 2 * node + 1, first_leaf, middle_leaf);
  split(means, 2 * node + 2, middle_leaf, last_leaf);
}

}  // namespace gramloom
