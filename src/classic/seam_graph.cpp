#include "classic/seam_graph.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace gramloom {

namespace {

/// The patch's pixels, and what a cut between two of them costs.
class Seam {
 public:
  Seam(const Image& old, const Image& fresh, const std::vector<Ground>& ground)
      : size_(old.size()), ground_(ground), difference_(to_size(old.width * old.height)) {
    for (std::size_t i = 0; i < difference_.size(); ++i)
      for (std::size_t c = 0; c < to_size(old.channels); ++c) {
        const std::size_t j = i * to_size(old.channels) + c;
        const float d = old.pixels[j] - fresh.pixels[j];
        difference_[i] += double{d} * double{d};
      }
  }

  Ground at(int x, int y) const {
    return ground_[to_size(y + 1) * to_size(size_.width + 2) + to_size(x + 1)];
  }
  bool inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
  }
  std::size_t index(int x, int y) const { return to_size(y) * to_size(size_.width) + to_size(x); }

  /// Between two neighbours, one of the patch and one of the ground. What isn't there on one of
  /// them (ground that is bare, or the patch beyond its edge) is as different as on the other.
  double cost(int ax, int ay, int bx, int by) const {
    const bool a = inside(ax, ay) && at(ax, ay) != Ground::bare;
    const bool b = inside(bx, by) && at(bx, by) != Ground::bare;
    const double of_a = a ? difference_[index(ax, ay)] : 0;
    const double of_b = b ? difference_[index(bx, by)] : 0;
    return a && b ? of_a + of_b : 2 * (of_a + of_b);
  }

 private:
  Size size_;
  const std::vector<Ground>& ground_;
  std::vector<double> difference_;
};

constexpr std::array<std::array<int, 2>, 4> around{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

}  // namespace

PatchCut graph_cut(const Image& old, const Image& fresh, const std::vector<Ground>& ground) {
  const Seam seam(old, fresh, ground);
  PatchCut result{std::vector<unsigned char>(to_size(old.width * old.height), 1)};
  std::vector<int> node(result.mask.size(), -1);
  int nodes = 0;
  for (int y = 0; y < old.height; ++y)
    for (int x = 0; x < old.width; ++x) {
      if (seam.at(x, y) == Ground::firm) result.mask[seam.index(x, y)] = 0;
      if (seam.at(x, y) == Ground::laid) node[seam.index(x, y)] = nodes++;
    }

  if (nodes == 0) nodes = 1;  // the graph's own search needs one, and an edge
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(nodes + 1),
                                    static_cast<unsigned>(4 * nodes));
  for (int i = 0; i <= nodes; ++i) graph.addVtx();
  graph.addEdges(0, nodes, 0, 0);
  for (int y = 0; y < old.height; ++y)
    for (int x = 0; x < old.width; ++x)
      for (const auto& [dx, dy] : around) {
        const int i = node[seam.index(x, y)];
        const Ground there = seam.at(x + dx, y + dy);
        if (there == Ground::bare && !seam.inside(x + dx, y + dy)) continue;
        const double cost = seam.cost(x, y, x + dx, y + dy);
        if (i < 0) {
          if (seam.at(x, y) == Ground::bare && there == Ground::firm) result.error += cost;
        } else if (!seam.inside(x + dx, y + dy) || there == Ground::firm) {
          graph.addTermWeights(i, cost, 0);  // where it is fresh there is a cut
        } else if (there == Ground::bare) {
          graph.addTermWeights(i, 0, cost);  // where it stays there is one
        } else if (dx + dy > 0) {
          graph.addEdges(i, node[seam.index(x + dx, y + dy)], cost, cost);
        }
      }
  result.error += graph.maxFlow();
  for (std::size_t p = 0; p < node.size(); ++p)
    if (node[p] >= 0 && graph.inSourceSegment(node[p])) result.mask[p] = 0;
  return result;
}

}  // namespace gramloom
