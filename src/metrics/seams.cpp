#include "metrics/seams.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gramloom {

namespace {

/// Mean step from line `at` to the next around the image.
double mean_step(const Image& image, bool columns, int at) {
  const int across = columns ? image.width : image.height;
  const int along = columns ? image.height : image.width;
  const int next = (at + 1) % across;
  double sum = 0;
  for (int i = 0; i < along; ++i) {
    const float* a = columns ? image.at(at, i) : image.at(i, at);
    const float* b = columns ? image.at(next, i) : image.at(i, next);
    double squares = 0;
    for (int c = 0; c < image.channels; ++c)
      squares += (double{a[c]} - double{b[c]}) * (double{a[c]} - double{b[c]});
    sum += std::sqrt(squares);
  }
  return sum / along;
}

/// Two neighbouring pixels, the second to the right of the first or below it.
struct Pair {
  int x, y;
  bool right;
};

std::vector<Pair> outline_of(const Image& mask) {
  std::vector<Pair> pairs;
  const auto made = [&](int x, int y) { return *mask.at(x, y) > 0.5f; };
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (x + 1 < mask.width && made(x, y) != made(x + 1, y)) pairs.push_back({x, y, true});
      if (y + 1 < mask.height && made(x, y) != made(x, y + 1)) pairs.push_back({x, y, false});
    }
  return pairs;
}

/// Mean step across an outline that is moved around the image; pairs that the image's own edges
/// part are left out.
double mean_step(const Image& image, const std::vector<Pair>& outline, int right, int down) {
  double sum = 0;
  double count = 0;
  for (const Pair& pair : outline) {
    const int x = (pair.x + right) % image.width;
    const int y = (pair.y + down) % image.height;
    const int next_x = x + (pair.right ? 1 : 0);
    const int next_y = y + (pair.right ? 0 : 1);
    if (next_x >= image.width || next_y >= image.height) continue;
    const float* a = image.at(x, y);
    const float* b = image.at(next_x, next_y);
    double squares = 0;
    for (int c = 0; c < image.channels; ++c)
      squares += (double{a[c]} - double{b[c]}) * (double{a[c]} - double{b[c]});
    sum += std::sqrt(squares);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

double ratio_to_strong(double seam, std::vector<double> inside) {
  const auto strong = inside.begin() + static_cast<std::ptrdiff_t>((inside.size() - 1) * 95 / 100);
  std::nth_element(inside.begin(), strong, inside.end());
  if (seam <= 0) return 0;
  return *strong > 0 ? std::min(seam_limit, seam / *strong) : seam_limit;
}

}  // namespace

double seam_visibility(const Image& image, bool right_edge) {
  const int across = right_edge ? image.width : image.height;
  if (across < 2) return 0;
  std::vector<double> inside;
  for (int at = 0; at + 1 < across; ++at) inside.push_back(mean_step(image, right_edge, at));
  return ratio_to_strong(mean_step(image, right_edge, across - 1), std::move(inside));
}

double join_visibility(const Image& image, const Image& mask) {
  constexpr int places = 16;  // in each direction
  const std::vector<Pair> outline = outline_of(mask);
  if (outline.empty()) return 0;
  std::vector<double> elsewhere;
  for (int i = 0; i < places; ++i)
    for (int j = 0; j < places; ++j)
      if (i > 0 || j > 0)
        elsewhere.push_back(
            mean_step(image, outline, i * image.width / places, j * image.height / places));
  return ratio_to_strong(mean_step(image, outline, 0, 0), std::move(elsewhere));
}

}  // namespace gramloom
