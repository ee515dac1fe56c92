#include "classic/pixel_quilted_start.h"

#include <algorithm>

#include "classic/pixel_match.h"

namespace gramloom::pixel {
namespace {

constexpr int block = 8;  // pixels of the level
constexpr int reach = 3;  // width of the ring around a block that is compared
constexpr double tolerance = 0.2;

/// How often blocks came from about each place.
class Uses {
 public:
  explicit Uses(const Level& level)
      : size_(level.colours.size()),
        near_(block * level.step / 2),
        counts_(static_cast<std::size_t>(level.count()), 0.0f) {}

  void add(Point p) {
    for (int y = std::max(0, p.y - near_); y < std::min(size_.height, p.y + near_); ++y)
      for (int x = std::max(0, p.x - near_); x < std::min(size_.width, p.x + near_); ++x)
        counts_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
                static_cast<std::size_t>(x)] += 1;
  }
  float operator[](std::size_t place) const { return counts_[place]; }

 private:
  Size size_;
  int near_;
  std::vector<float> counts_;
};

/// The known pixels in a block and in the ring around it.
std::vector<Known> surroundings(const Canvas& canvas, const std::vector<bool>& known,
                                const Level& level, const Reference& reference, Point first) {
  std::vector<Known> found;
  for (int dy = -reach; dy < block + reach; ++dy)
    for (int dx = -reach; dx < block + reach; ++dx) {
      int x = first.x + dx, y = first.y + dy;
      if (!canvas.wrap(x, y) || !known[canvas.index(x, y)]) continue;
      const Point p = canvas.at(x, y);
      found.push_back({reference.offset(dx, dy), 1.0f, level.colours.at(p.x, p.y)});
    }
  return found;
}

}  // namespace

Canvas quilted_start(const Level& level, Size size, Tile tile, double variety, Random random) {
  const Image& colours = level.colours;
  const Reference reference(level, block + reach);
  // Places from which a whole block fits into the exemplar; where none does, it is cut off.
  const Size places{std::max(1, colours.width - (block - 1) * level.step),
                    std::max(1, colours.height - (block - 1) * level.step)};
  Canvas canvas(size, tile);
  std::vector<bool> known(canvas.source.size(), false);
  Uses uses(level);
  std::vector<float> errors;

  for (int top = 0; top < size.height; top += block)
    for (int left = 0; left < size.width; left += block) {
      const auto everywhere =
          reference.errors(surroundings(canvas, known, level, reference, {left, top}));
      errors.clear();
      for (int y = 0; y < places.height; ++y)
        for (int x = 0; x < places.width; ++x) {
          const auto place = static_cast<std::size_t>(level.index({x, y}));
          errors.push_back(everywhere[place] * (1 + static_cast<float>(variety) * uses[place]));
        }
      const int chosen = static_cast<int>(pick(errors, tolerance, random));
      const Point from{chosen % places.width, chosen / places.width};
      uses.add(from);
      for (int y = top; y < std::min(top + block, size.height); ++y)
        for (int x = left; x < std::min(left + block, size.width); ++x) {
          canvas.at(x, y) =
              level.nearest({from.x + (x - left) * level.step, from.y + (y - top) * level.step});
          known[canvas.index(x, y)] = true;
        }
    }
  return canvas;
}

}  // namespace gramloom::pixel
