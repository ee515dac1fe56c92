#include "signal/window.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace gramloom {

std::vector<double> raised_cosine(int length, double fade) {
  std::vector<double> window(static_cast<std::size_t>(length), 1.0);
  for (std::size_t i = 0; i < window.size(); ++i) {
    const double place = (static_cast<double>(i) + 0.5) / length;
    const double from_edge = std::min(place, 1 - place);
    if (from_edge < fade) window[i] = 0.5 - 0.5 * std::cos(std::numbers::pi * from_edge / fade);
  }
  return window;
}

std::vector<float> scaled_to_energy(const std::vector<double>& window, double energy) {
  const double own = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  const double scale = std::sqrt(energy / own);
  std::vector<float> scaled;
  for (const double w : window) scaled.push_back(static_cast<float>(scale * w));
  return scaled;
}

}  // namespace gramloom
