#include "classic/pixel_quilted_start.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "classic/pixel_match.h"
#include "signal/united.h"

namespace gramloom::pixel {
namespace {

constexpr int block = 8;  // pixels of the level
constexpr int reach = 3;  // width of the ring around a block that is compared
constexpr double tolerance = 0.2;
/// In a fill what goes on must go on in phase: more is compared, and the best place is taken.
constexpr int reach_of_fill = 12;
constexpr float weight_far = 0.04f;  // of what is beyond the usual ring

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

/// The known pixels in a block and in the ring around it; and, of half of those beyond it, as many
/// as lie within `ring`.
struct Surroundings {
  std::vector<Known> near, far;
};
Surroundings surroundings(const Canvas& canvas, const std::vector<bool>& known, const Level& level,
                          const Aim& aim, const Reference& reference, Point first, int ring) {
  Surroundings found;
  for (int dy = -ring; dy < block + ring; ++dy)
    for (int dx = -ring; dx < block + ring; ++dx) {
      int x = first.x + dx, y = first.y + dy;
      if (!canvas.wrap(x, y) || !known[canvas.index(x, y)]) continue;
      const bool far = std::min(dx, dy) < -reach || std::max(dx, dy) >= block + reach;
      if (far && (dx + dy) % 2 != 0) continue;
      const Point p = canvas.at(x, y);
      (far ? found.far : found.near)
          .push_back({reference.offset(dx, dy), far ? weight_far : 1.0f,
                      aim.is_made(canvas.index(x, y)) ? level.colours.at(p.x, p.y)
                                                      : aim.colours.at(x, y)});
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

/// The blocks to be laid: in scan order, or, of a fill, from the borders of holes inwards, as what
/// is surrounded most is determined best.
class BlockOrder {
 public:
  BlockOrder(const Canvas& canvas, const std::vector<bool>& known, const Aim& aim, int ring)
      : canvas_(canvas), known_(known), fills_(!aim.made.empty()), ring_(ring) {
    for (int top = 0; top < aim.size.height; top += block)
      for (int left = 0; left < aim.size.width; left += block)
        if (!fills_ || any_made(aim, {left, top}))
          rest_.push_back({{left, top}, fills_ ? count_known({left, top}) : 0});
  }

  std::optional<Point> next() {
    if (done_ == rest_.size()) return std::nullopt;
    const auto first = rest_.begin() + static_cast<std::ptrdiff_t>(done_++);
    if (fills_)
      std::iter_swap(first, std::ranges::max_element(first, rest_.end(), {}, &Waiting::known));
    return first->place;
  }

  /// Its pixels are known now.
  void laid(Point place) {
    if (!fills_) return;
    for (auto waiting = rest_.begin() + static_cast<std::ptrdiff_t>(done_); waiting != rest_.end();
         ++waiting)
      if (is_near(waiting->place.x - place.x, canvas_.size.width, tiles_x(canvas_.tile)) &&
          is_near(waiting->place.y - place.y, canvas_.size.height, tiles_y(canvas_.tile)))
        waiting->known = count_known(waiting->place);
  }

 private:
  struct Waiting {
    Point place;
    int known;  // pixels of the block and the ring around it
  };

  bool is_near(int distance, int side, bool wraps) const {
    distance = std::abs(distance);
    return std::min(distance, wraps ? side - distance : distance) < block + ring_;
  }

  int count_known(Point first) const {
    int count = 0;
    for (int dy = -ring_; dy < block + ring_; ++dy)
      for (int dx = -ring_; dx < block + ring_; ++dx)
        if (int x = first.x + dx, y = first.y + dy; canvas_.wrap(x, y))
          count += known_[canvas_.index(x, y)] ? 1 : 0;
    return count;
  }

  const Canvas& canvas_;
  const std::vector<bool>& known_;
  bool fills_;
  int ring_;
  std::vector<Waiting> rest_;
  std::size_t done_ = 0;
};

}  // namespace

Canvas quilted_start(const Level& level, const Aim& aim, Tile tile, double variety,
                     ExemplarQuota quota, int factor, Random random) {
  const Image& colours = level.colours;
  const Size size = aim.size;
  const bool fills = !aim.made.empty();
  const int ring = fills ? reach_of_fill : reach;
  const Reference reference(level, block + ring);
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

  BlockOrder order(canvas, known, aim, ring);
  while (const std::optional<Point> next = order.next()) {
    const auto [left, top] = *next;
    const auto [about, far] = surroundings(canvas, known, level, aim, reference, {left, top}, ring);
    std::vector<float> everywhere = reference.errors(about);
    if (!far.empty())
      std::ranges::transform(everywhere, reference.far_errors(far), everywhere.begin(),
                             std::plus<float>());
    // Of the guide as much a pixel as of the colours.
    const float part = (about.empty() ? 1.0f : static_cast<float>(about.size())) / (block * block);
    const std::vector<float> costs = quota.costs();
    errors.clear();
    for (int y = 0; y < places.height; ++y)
      for (int x = 0; x < places.width; ++x) {
        const auto place = static_cast<std::size_t>(level.index({x, y}));
        errors.push_back(everywhere[place] * (1 + static_cast<float>(variety) * uses[place]));
        if (!usable.empty() && usable[errors.size() - 1] == 0)
          errors.back() = out_of_reach;
        else if (!quota.empty())
          errors.back() += static_cast<float>(about.size()) * costs[quota.exemplar_at(x * factor)];
        else if (!aim.guide.empty())
          errors.back() += part * guide_error(level, aim, {left, top}, {x, y});
      }
    const int chosen = static_cast<int>(pick(errors, fills ? 0 : tolerance, random));
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
    order.laid({left, top});
  }
  return canvas;
}

}  // namespace gramloom::pixel
