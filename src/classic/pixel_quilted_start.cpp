#include "classic/pixel_quilted_start.h"

#include <algorithm>

#include "classic/pixel_match.h"
#include "signal/united.h"

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
                                const Level& level, const Aim& aim, const Reference& reference,
                                Point first) {
  std::vector<Known> found;
  for (int dy = -reach; dy < block + reach; ++dy)
    for (int dx = -reach; dx < block + reach; ++dx) {
      int x = first.x + dx, y = first.y + dy;
      if (!canvas.wrap(x, y) || !known[canvas.index(x, y)]) continue;
      const Point p = canvas.at(x, y);
      found.push_back(
          {reference.offset(dx, dy), 1.0f,
           aim.is_made(canvas.index(x, y)) ? level.colours.at(p.x, p.y) : aim.colours.at(x, y)});
    }
  return found;
}

/// Places whose block lies in usable samples; where there is none, those whose middle does.
std::vector<unsigned char> usable_places(const Level& level, Size places) {
  std::vector<unsigned char> usable;
  if (level.usable.empty()) return usable;
  const int side = (block - 1) * level.step;
  Image mask(level.colours.size(), 1);
  for (int i = 0; i < level.count(); ++i)
    mask.pixels[static_cast<std::size_t>(i)] = level.may_use(i) ? 1.0f : 0.0f;
  usable = usable_origins(mask, mask.size(), {side + 1, side + 1});
  if (std::ranges::find(usable, 1) != usable.end()) return usable;
  usable.clear();
  for (int y = 0; y < places.height; ++y)
    for (int x = 0; x < places.width; ++x)
      usable.push_back(level.may_use(level.index(level.nearest({x + side / 2, y + side / 2}))) ? 1
                                                                                               : 0);
  if (std::ranges::find(usable, 1) == usable.end()) usable.clear();
  return usable;
}

/// Σ guide_error over the made pixels of a block that comes from `from`.
float guide_error(const Level& level, const Aim& aim, Point first, Point from) {
  float sum = 0;
  for (int y = first.y; y < std::min(first.y + block, aim.size.height); ++y)
    for (int x = first.x; x < std::min(first.x + block, aim.size.width); ++x)
      if (aim.is_made(aim.index(x, y)))
        sum += aim.guide_error(level,
                               level.index(level.nearest({from.x + (x - first.x) * level.step,
                                                          from.y + (y - first.y) * level.step})),
                               x, y);
  return sum;
}

bool any_made(const Aim& aim, Point first) {
  for (int y = first.y; y < std::min(first.y + block, aim.size.height); ++y)
    for (int x = first.x; x < std::min(first.x + block, aim.size.width); ++x)
      if (aim.is_made(aim.index(x, y))) return true;
  return false;
}

}  // namespace

Canvas quilted_start(const Level& level, const Aim& aim, Tile tile, double variety,
                     ExemplarQuota quota, int factor, Random random) {
  const Image& colours = level.colours;
  const Size size = aim.size;
  const Reference reference(level, block + reach);
  // Places from which a whole block fits into the exemplar; where none does, it is cut off.
  const Size places{std::max(1, colours.width - (block - 1) * level.step),
                    std::max(1, colours.height - (block - 1) * level.step)};
  const std::vector<unsigned char> usable = usable_places(level, places);
  Canvas canvas(size, tile);
  if (!level.usable.empty()) std::ranges::fill(canvas.source, level.nearest_usable({0, 0}));
  std::vector<bool> known(canvas.source.size(), false);
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = !aim.is_made(i);
  Uses uses(level);
  std::vector<float> errors;

  for (int top = 0; top < size.height; top += block)
    for (int left = 0; left < size.width; left += block) {
      if (!aim.made.empty() && !any_made(aim, {left, top})) continue;
      const auto about = surroundings(canvas, known, level, aim, reference, {left, top});
      const auto everywhere = reference.errors(about);
      // Of the guide as much a pixel as of the colours.
      const float part =
          (about.empty() ? 1.0f : static_cast<float>(about.size())) / (block * block);
      const std::vector<float> costs = quota.costs();
      errors.clear();
      for (int y = 0; y < places.height; ++y)
        for (int x = 0; x < places.width; ++x) {
          const auto place = static_cast<std::size_t>(level.index({x, y}));
          errors.push_back(everywhere[place] * (1 + static_cast<float>(variety) * uses[place]));
          if (!usable.empty() && usable[errors.size() - 1] == 0)
            errors.back() = out_of_reach;
          else if (!quota.empty())
            errors.back() +=
                static_cast<float>(about.size()) * costs[quota.exemplar_at(x * factor)];
          else if (!aim.guide.empty())
            errors.back() += part * guide_error(level, aim, {left, top}, {x, y});
        }
      const int chosen = static_cast<int>(pick(errors, tolerance, random));
      const Point from{chosen % places.width, chosen / places.width};
      uses.add(from);
      if (!quota.empty())
        quota.add(quota.exemplar_at(from.x * factor), 1.0 * block * block / canvas.count());
      for (int y = top; y < std::min(top + block, size.height); ++y)
        for (int x = left; x < std::min(left + block, size.width); ++x) {
          if (!aim.is_made(canvas.index(x, y))) continue;
          canvas.at(x, y) = level.nearest_usable(
              {from.x + (x - left) * level.step, from.y + (y - top) * level.step});
          known[canvas.index(x, y)] = true;
        }
    }
  return canvas;
}

}  // namespace gramloom::pixel
