#include "classic/patch_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "classic/patch_vote.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int sweeps = 3;

float difference(const float* a, const float* b, int features) {
  float sum = 0;
  for (int c = 0; c < features; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

/// The pixels of a hole as they are chosen.
class Choice {
 public:
  Choice(const PatchHole& hole, const PatchSource& source)
      : hole_(hole),
        source_(source),
        size_(texture_size(hole.field)),
        chosen_(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height)) {}

  std::vector<SmallOrigin> run() {
    for_each_made(-1,
                  [&](int x, int y) { choose(x, y, [&](PatchOrigin o) { return fit(x, y, o); }); });
    for (int sweep = 0; sweep < 2 * sweeps; ++sweep)
      for_each_made(sweep % 2, [&](int x, int y) {
        choose(x, y, [&](PatchOrigin o) { return fit(x, y, o) + cuts(x, y, o); });
      });
    return std::move(chosen_);
  }

 private:
  static constexpr std::array<PatchOrigin, 4> sides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }
  bool is_made(int x, int y) const { return hole_.made[index(x, y)] != 0; }

  /// Calls f(x, y) for made pixels, of one colour of a chessboard or (-1) of both.
  template <class F>
  void for_each_made(int colour, F&& f) {
    parallel_for(size_.height, 8, [&](std::int64_t first, std::int64_t last) {
      for (int y = static_cast<int>(first); y < last; ++y)
        for (int x = 0; x < size_.width; ++x)
          if (is_made(x, y) && (colour < 0 || (x + y) % 2 == colour)) f(x, y);
    });
  }

  /// The neighbour at a side, around edges that tile; false: there is none.
  bool neighbour(int& x, int& y, PatchOrigin side) const {
    x += side.x;
    y += side.y;
    if (tiles_x(hole_.field.tile)) x = (x + size_.width) % size_.width;
    if (tiles_y(hole_.field.tile)) y = (y + size_.height) % size_.height;
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height;
  }
  bool contains(PatchOrigin o) const {
    return o.x >= 0 && o.y >= 0 && o.x < source_.features.width && o.y < source_.features.height;
  }

  float fit(int x, int y, PatchOrigin o) const {
    float cost = difference(source_.features.at(o.x, o.y), hole_.canvas.at(x, y), field_features);
    for (std::size_t plane = 0; plane < hole_.guide.wanted.size(); ++plane)
      cost += *hole_.guide_weight.at(x, y) * difference(source_.guide[plane].at(o.x, o.y),
                                                        hole_.guide.wanted[plane].at(x, y),
                                                        field_features);
    return cost;
  }

  float cuts(int x, int y, PatchOrigin o) const {
    float cost = 0;
    for (const PatchOrigin side : sides) {
      int u = x, v = y;
      if (!neighbour(u, v, side)) continue;
      const PatchOrigin beside{o.x + side.x, o.y + side.y};
      if (!is_made(u, v)) {
        if (contains(beside))
          cost +=
              difference(source_.features.at(beside.x, beside.y), hole_.canvas.at(u, v), colours);
        continue;
      }
      const PatchOrigin other = chosen_[index(u, v)];
      if (other == beside) continue;
      const PatchOrigin back{other.x - side.x, other.y - side.y};
      if (contains(beside))
        cost += difference(source_.features.at(beside.x, beside.y),
                           source_.features.at(other.x, other.y), colours);
      if (contains(back))
        cost +=
            difference(source_.features.at(o.x, o.y), source_.features.at(back.x, back.y), colours);
    }
    return cost;
  }

  template <class Cost>
  void choose(int x, int y, Cost&& cost) {
    float best = std::numeric_limits<float>::infinity();
    SmallOrigin pixel;
    for_each_said(hole_.field, x, y, [&](PatchOrigin origin) {
      const float c = cost(origin);
      if (c < best) {
        best = c;
        pixel = origin;
      }
    });
    chosen_[index(x, y)] = pixel;
  }

  static constexpr int colours = field_features - 1;

  const PatchHole& hole_;
  const PatchSource& source_;
  Size size_;
  std::vector<SmallOrigin> chosen_;
};

}  // namespace

std::vector<SmallOrigin> choose_pixels(const PatchHole& hole, const PatchSource& source) {
  return Choice(hole, source).run();
}

}  // namespace gramloom
