#include "neural/flow/vote.h"

#include <cmath>

#include "core/threads.h"

namespace gramloom::neural {

namespace {

constexpr float least_weight = 1e-4f;  // below it a patch can't be seen
constexpr int rows_at_once = 16;

}  // namespace

std::vector<float> vote_window(int side, double spread) {
  std::vector<float> window;
  const auto along = [&](int i) {
    // From −side/2 to side/2, both included.
    const double at = (static_cast<double>(i) / (side - 1) - 0.5) * 2 * (side / 2);
    return std::exp(-at * at / 2 / (side * spread) / (side * spread));
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) window.push_back(static_cast<float>(along(y) * along(x)));
  return window;
}

Image vote(Size size, const std::vector<PatchPlace>& queries, const Image& exemplar,
           const std::vector<PatchPlace>& references, const Neighbours& nearest,
           const std::vector<float>& weights, int side, const std::vector<float>& window,
           const Agreement& agreement) {
  const int channels = exemplar.channels;
  Image sum(size, channels), total(size, 1);
  // Queries by the row of the picture on which they begin.
  std::vector<std::vector<std::uint32_t>> by_row(static_cast<std::size_t>(size.height));
  for (std::size_t q = 0; q < queries.size(); ++q)
    by_row[static_cast<std::size_t>(queries[q].y)].push_back(static_cast<std::uint32_t>(q));
  const auto k = static_cast<std::size_t>(nearest.neighbours);
  parallel_for(size.height, rows_at_once, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t y = begin; y < end; ++y)
      for (int dy = 0; dy < side; ++dy) {
        const std::int64_t from = ((y - dy) % size.height + size.height) % size.height;
        for (const std::uint32_t q : by_row[static_cast<std::size_t>(from)]) {
          const PatchPlace place = queries[q];
          for (int dx = 0; dx < side; ++dx) {
            const int x = (place.x + dx) % size.width;
            const float in_window = window[static_cast<std::size_t>(dy * side + dx)];
            if (!agreement) total.at(x, static_cast<int>(y))[0] += in_window;
          }
          for (std::size_t j = 0; j < k; ++j) {
            const float weight = weights[q * k + j];
            if (weight < least_weight) continue;
            const PatchPlace r = references[static_cast<std::size_t>(nearest.reference[q * k + j])];
            for (int dx = 0; dx < side; ++dx) {
              const int x = (place.x + dx) % size.width;
              float factor = weight * window[static_cast<std::size_t>(dy * side + dx)];
              if (agreement) {
                factor *= agreement(x, static_cast<int>(y), r.x + dx, r.y + dy);
                total.at(x, static_cast<int>(y))[0] += factor;
              }
              const float* in = exemplar.at(r.x + dx, r.y + dy);
              float* out = sum.at(x, static_cast<int>(y));
              for (int c = 0; c < channels; ++c) out[c] += factor * in[c];
            }
          }
        }
      }
    for (std::int64_t y = begin; y < end; ++y)
      for (int x = 0; x < size.width; ++x)
        if (const float w = total.at(x, static_cast<int>(y))[0]; w > 0)
          for (int c = 0; c < channels; ++c) sum.at(x, static_cast<int>(y))[c] /= w;
  });
  return sum;
}

}  // namespace gramloom::neural
