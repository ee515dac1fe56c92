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

}  // namespace

double seam_visibility(const Image& image, bool right_edge) {
  const int across = right_edge ? image.width : image.height;
  if (across < 2) return 0;
  std::vector<double> inside;
  for (int at = 0; at + 1 < across; ++at) inside.push_back(mean_step(image, right_edge, at));
  const auto strong = inside.begin() + static_cast<std::ptrdiff_t>((inside.size() - 1) * 95 / 100);
  std::nth_element(inside.begin(), strong, inside.end());
  const double seam = mean_step(image, right_edge, across - 1);
  if (seam <= 0) return 0;
  return *strong > 0 ? std::min(seam_limit, seam / *strong) : seam_limit;
}

}  // namespace gramloom
