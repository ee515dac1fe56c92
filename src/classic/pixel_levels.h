#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/image.h"
#include "signal/colour_pca.h"

namespace gramloom::pixel {

/// A position in an exemplar, in samples of its level.
struct Point {
  int x = 0;
  int y = 0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// The exemplar as one level of the synthesis compares it: blurred for that level, channels
/// decorrelated, mean 0. Level 0 is the exemplar; a pixel of level l is 2^l of its pixels wide.
/// Coarse levels are sampled twice as densely as their pixels, so that a coarse result may take
/// its pixels from between the pixels of an ordinary pyramid (as the Gaussian stack of Lefebvre &
/// Hoppe 2005, at a third of its size).
struct Level {
  Image colours;
  int step = 1;      // samples between neighbouring pixels of this level
  int ratio = 1;     // samples of the next finer level for one of this level
  Image guide = {};  // of a directed synthesis (pixel_direction.h): the guide, and its local mean
  std::vector<int> usable = {};  // the index of the nearest sample that may be used; empty: its own

  int count() const { return colours.width * colours.height; }
  int index(Point p) const { return p.y * colours.width + p.x; }
  Point point(int index) const { return {index % colours.width, index / colours.width}; }
  /// p, or the sample of the edge that is nearest to it.
  Point nearest(Point p) const {
    return {std::clamp(p.x, 0, colours.width - 1), std::clamp(p.y, 0, colours.height - 1)};
  }
  bool may_use(int index) const {
    return usable.empty() || usable[static_cast<std::size_t>(index)] == index;
  }
  /// The sample that may be used and is nearest to p, about.
  Point nearest_usable(Point p) const {
    p = nearest(p);
    return usable.empty() ? p : point(usable[static_cast<std::size_t>(index(p))]);
  }
  /// p, or its mirror image where it lies outside.
  Point mirrored(Point p) const {
    return {mirrored(p.x, colours.width), mirrored(p.y, colours.height)};
  }
  static int mirrored(int x, int size) {
    const int period = std::max(1, 2 * size - 2);
    x = std::abs(x) % period;
    return x < size ? x : period - x;
  }
  bool contains(Point p) const {
    return p.x >= 0 && p.y >= 0 && p.x < colours.width && p.y < colours.height;
  }
};

/// What comparisons see of colours: along the exemplar's principal axes, the first 4 where it has
/// more channels, scaled so that their variance, summed over channels, is 1.
Image comparison_colours(const Image& image, const ColourPca& exemplar);

/// Finest first.
std::vector<Level> make_levels(const Image& exemplar, int count);

/// The 5-tap binomial filter of the Gaussian pyramid, and every second sample, from the first.
Image blurred(const Image& image);
Image halved_samples(const Image& image);

/// `asked`, or if that is 0 as many as bring the shorter side of both down to 20 to 39 pixels;
/// never more than leave the exemplar a pixel.
int level_count(int asked, Size exemplar, Size result);

/// `image` with `border` more pixels on each side, mirrored without repeating the edge pixel.
Image mirrored(const Image& image, int border);

}  // namespace gramloom::pixel
