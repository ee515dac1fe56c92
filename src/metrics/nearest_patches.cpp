#include "metrics/nearest_patches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/simd.h"
#include "core/threads.h"
#include "metrics/components.h"

namespace gramloom {

namespace {

static_assert(component_count == field_features);

constexpr int passes = 4;
constexpr int tries = 4;
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

/// Pixel (x, y) is the mean of the 4×4 pixels from there on.
Image box_means(const Image& image) {
  Image result(image.size(), image.channels);
  const cv::Mat in(image.height, image.width, CV_32FC(component_count),
                   const_cast<float*>(image.pixels.data()));
  cv::Mat out(image.height, image.width, CV_32FC(component_count), result.pixels.data());
  cv::blur(in, out, {4, 4}, {0, 0}, cv::BORDER_REFLECT);
  return result;
}

/// A balanced tree over an exemplar's patches. Node n has children 2n + 1 and 2n + 2; all leaves
/// lie at one depth, and the patches of leaf l are those from count·l/leaves on.
class PatchTree {
 public:
  explicit PatchTree(const Image& exemplar)
      : means_(box_means(exemplar)), origins_(patch_origins(exemplar.size())) {
    const std::int64_t count = std::int64_t{origins_.width} * origins_.height;
    while (leaves_ * leaf_patches < count) leaves_ *= 2;
    patches_.resize(static_cast<std::size_t>(count));
    std::iota(patches_.begin(), patches_.end(), 0);
    nodes_.resize(static_cast<std::size_t>(leaves_ - 1));
    split(0, 0, leaves_);
  }

  PatchOrigin origin(std::int64_t place) const {
    const int patch = patches_[static_cast<std::size_t>(place)];
    return {patch % origins_.width, patch / origins_.width};
  }
  std::int64_t first_of(std::int64_t leaf) const {
    return static_cast<std::int64_t>(patches_.size()) * leaf / leaves_;
  }
  /// The leaf in which the patch at (x, y) of another image's box means would lie.
  std::int64_t leaf(const Image& means, int x, int y) const {
    std::int64_t node = 0;
    while (node < leaves_ - 1) {
      const Node& n = nodes_[static_cast<std::size_t>(node)];
      const Box& box = boxes[n.box];
      const bool below = means.at(x + box.x, y + box.y)[box.component] < n.value;
      node = 2 * node + (below ? 1 : 2);
    }
    return node - (leaves_ - 1);
  }

 private:
  struct Node {
    std::size_t box = 0;
    float value = 0;
  };

  float value(int patch, const Box& box) const {
    return means_.at(patch % origins_.width + box.x, patch / origins_.width + box.y)[box.component];
  }

  /// The box that varies most among up to 64 of the patches.
  std::size_t widest_box(std::int64_t begin, std::int64_t end) const {
    const std::int64_t step = std::max<std::int64_t>(1, (end - begin) / 64);
    std::size_t best = 0;
    double most = -1;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      double sum = 0, squares = 0, n = 0;
      for (std::int64_t i = begin; i < end; i += step, ++n) {
        const double v = double{value(patches_[static_cast<std::size_t>(i)], boxes[b])};
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

  void split(std::int64_t node, std::int64_t first_leaf, std::int64_t last_leaf) {
    if (last_leaf - first_leaf == 1) return;
    const std::int64_t middle_leaf = (first_leaf + last_leaf) / 2;
    const std::int64_t begin = first_of(first_leaf), end = first_of(last_leaf);
    const std::int64_t middle = first_of(middle_leaf);
    Node& n = nodes_[static_cast<std::size_t>(node)];
    n.box = widest_box(begin, end);
    const Box& box = boxes[n.box];
    if (middle < end) {
      // By place where values are equal, so that the order is the same with any library.
      std::nth_element(patches_.begin() + begin, patches_.begin() + middle, patches_.begin() + end,
                       [&](int a, int b) {
                         const float u = value(a, box), v = value(b, box);
                         return u != v ? u < v : a < b;
                       });
      n.value = value(patches_[static_cast<std::size_t>(middle)], box);
    }
    split(2 * node + 1, first_leaf, middle_leaf);
    split(2 * node + 2, middle_leaf, last_leaf);
  }

  Image means_;
  Size origins_;
  std::int64_t leaves_ = 1;
  std::vector<int> patches_;
  std::vector<Node> nodes_;
};

constexpr int lanes = 8;
typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)), aligned(4), may_alias));

GRAMLOOM_INLINE float squared_distance(const Image& a, int ax, int ay, const Image& b, int bx,
                                       int by) {
  Lanes sums = {};
  for (int y = 0; y < field_patch; ++y) {
    const Lanes* u = reinterpret_cast<const Lanes*>(a.at(ax, ay + y));
    const Lanes* v = reinterpret_cast<const Lanes*>(b.at(bx, by + y));
    for (int k = 0; k < field_patch * field_features / lanes; ++k) {
      const Lanes d = u[k] - v[k];
      sums += d * d;
    }
  }
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

/// The best of each patch's leaf, for one row.
GRAMLOOM_SIMD void search_leaves(PatchField& field, int y, const Image& image,
                                 const Image& exemplar, const Image& means, const PatchTree& tree) {
  for (int x = 0; x < field.size.width; ++x) {
    const std::int64_t leaf = tree.leaf(means, x, y);
    const std::int64_t end = tree.first_of(leaf + 1);
    float best = std::numeric_limits<float>::infinity();
    for (std::int64_t i = tree.first_of(leaf); i < end; ++i) {
      const PatchOrigin o = tree.origin(i);
      const float distance = squared_distance(image, x, y, exemplar, o.x, o.y);
      if (distance >= best) continue;
      best = distance;
      field.nearest[field.index(x, y)] = o;
    }
  }
}

}  // namespace

PatchField nearest_patches(const Image& image, const Image& exemplar) {
  const Size size = patch_origins(image.size());
  PatchField field = blank_field(size, Tile::none);
  {
    const PatchTree tree(exemplar);
    const Image means = box_means(image);
    parallel_for(size.height, 4, [&](std::int64_t begin, std::int64_t end) {
      for (auto y = static_cast<int>(begin); y < end; ++y)
        search_leaves(field, y, image, exemplar, means, tree);
    });
  }
  const PatchPenalty none(size, patch_origins(exemplar.size()));
  for (int pass = 0; pass < passes; ++pass)
    improve(field, image, exemplar, none, pass, tries, Random(0, static_cast<std::uint64_t>(pass)));
  return field;
}

}  // namespace gramloom
