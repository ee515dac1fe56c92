#include "classic/patch_growth.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "classic/patch_vote.h"
#include "core/threads.h"

namespace gramloom {

namespace {

constexpr int middle = field_patch / 2;
using Pixel = FeaturePixel;

int wrapped(int i, int length) { return (i % length + length) % length; }

/// A patch and how urgent it was when it was put into the queue.
struct Turn {
  bool in_front = false;  // its middle is unknown and next to a known pixel
  float priority = 0;
  int patch = 0;

  friend bool operator<(const Turn& a, const Turn& b) {
    return std::tuple(a.in_front, a.priority, b.patch) <
           std::tuple(b.in_front, b.priority, a.patch);
  }
  friend bool operator==(const Turn&, const Turn&) = default;
};

class Growth {
 public:
  Growth(PatchHole& hole, const GrowthPlaces& places)
      : hole_(hole),
        source_(*places.source),
        places_(places),
        origins_(places.origins),
        size_(texture_size(hole.field)),
        left_(hole.made),
        confidence_(left_.size()),
        from_(left_.size(), {-1, -1}),
        costs_(origins_.size()) {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      confidence_[i] = left_[i] != 0 ? 0.0f : 1.0f;
    }
  }

  void run(float tolerance, Random& random) {
    const Size field = hole_.field.size;
    for (int y = 0; y < field.height; ++y)
      for (int x = 0; x < field.width; ++x) ask(x, y);
    if (std::ranges::all_of(left_, [](unsigned char v) { return v != 0; }))
      fill(field.width / 2, field.height / 2, tolerance, random);
    while (!queue_.empty()) {
      const Turn turn = queue_.top();
      queue_.pop();
      const int x = turn.patch % field.width, y = turn.patch / field.width;
      const Turn now = turn_of(x, y);
      if (now.priority <= 0 || !(now == turn)) continue;  // it was asked again since, or is done
      fill(x, y, tolerance, random);
    }
    set_field(random);
  }

 private:
  std::size_t pixel(int x, int y) const {
    return to_size(y % size_.height) * to_size(size_.width) + to_size(x % size_.width);
  }
  bool is_known(int x, int y) const {
    if (tiles_x(hole_.field.tile)) x = wrapped(x, size_.width);
    if (tiles_y(hole_.field.tile)) y = wrapped(y, size_.height);
    return x >= 0 && y >= 0 && x < size_.width && y < size_.height && left_[pixel(x, y)] == 0;
  }

  Turn turn_of(int x, int y) const {
    Turn turn{.patch = y * hole_.field.size.width + x};
    if (!hole_.field.looks_for(to_size(turn.patch))) return turn;
    int known = 0;
    float trust = 0;
    Pixel sum{}, squares{};
    for (int j = 0; j < field_patch; ++j)
      for (int i = 0; i < field_patch; ++i) {
        const std::size_t at = pixel(x + i, y + j);
        if (left_[at] != 0) continue;
        const Pixel value = *reinterpret_cast<const Pixel*>(hole_.canvas.at(x + i, y + j));
        sum += value;
        squares += value * value;
        trust += confidence_[at];
        ++known;
      }
    if (known == 0 || known == field_patch * field_patch) return turn;
    const auto count = static_cast<float>(known);
    const Pixel variance = squares / count - sum / count * (sum / count);
    const float spread =
        std::sqrt(std::max(0.0f, (variance[0] + variance[1]) + (variance[2] + variance[3])));
    turn.priority = trust * (spread + 0.1f);
    const int u = x + middle, v = y + middle;
    turn.in_front = left_[pixel(u, v)] != 0 && (is_known(u - 1, v) || is_known(u + 1, v) ||
                                                is_known(u, v - 1) || is_known(u, v + 1));
    return turn;
  }

  void ask(int x, int y) {
    if (const Turn turn = turn_of(x, y); turn.priority > 0) queue_.push(turn);
  }

  /// Adds a known pixel that lies (i, j) from a patch's first.
  void add_known(int x, int y, int i, int j, float weight, WantedPatch& wanted) const {
    if (!is_known(x + i, y + j)) return;
    const int u = wrapped(x + i, size_.width), v = wrapped(y + j, size_.height);
    wanted.pixels.push_back({*reinterpret_cast<const Pixel*>(hole_.canvas.at(u, v)), weight,
                             std::ptrdiff_t{j} * places_.features.width + i});
    wanted.weight += weight;
  }

  WantedPatch wanted_of(int x, int y) const {
    WantedPatch wanted;
    for (int j = 0; j < field_patch; ++j)
      for (int i = 0; i < field_patch; ++i) add_known(x, y, i, j, 1, wanted);
    // Of those about it, every second one tells enough.
    constexpr int far = field_patch + growth_context;
    for (int j = -growth_context; j < far; ++j)
      for (int i = -growth_context; i < far; ++i)
        if ((i < 0 || j < 0 || i >= field_patch || j >= field_patch) && (i + j) % 2 == 0)
          add_known(x, y, i, j, context_weight, wanted);
    wanted.x = x;
    wanted.y = y;
    wanted.guide = &hole_.guide;
    if (!hole_.guide.weight.empty())
      wanted.guide_weight = hole_.guide.weight[hole_.field.index(x, y)];
    return wanted;
  }

  PatchOrigin find(int x, int y, float tolerance, Random& random) {
    const WantedPatch wanted = wanted_of(x, y);
    parallel_for(std::ssize(origins_), 4096, [&](std::int64_t first, std::int64_t last) {
      compare(wanted, places_, static_cast<std::size_t>(first), static_cast<std::size_t>(last),
              1 + tolerance, costs_.data());
    });
    const auto best = std::ranges::min_element(costs_);
    if (tolerance <= 0) return origins_[static_cast<std::size_t>(best - costs_.begin())];
    constexpr float as_good = 1e-4f * patch_area;
    const float limit = *best * (1 + tolerance) + (wanted.pixels.empty() ? as_good : 0);
    std::uint32_t like = 0;
    for (const float cost : costs_) like += cost <= limit ? 1 : 0;
    std::uint32_t skip = random.below(like);
    for (std::size_t i = 0;; ++i)
      if (costs_[i] <= limit && skip-- == 0) return origins_[i];
  }

  void fill(int x, int y, float tolerance, Random& random) {
    const PatchOrigin origin = find(x, y, tolerance, random);
    float trust = 0;
    for (int j = 0; j < field_patch; ++j)
      for (int i = 0; i < field_patch; ++i) trust += confidence_[pixel(x + i, y + j)];
    trust /= field_patch * field_patch;
    for (int j = 0; j < field_patch; ++j)
      for (int i = 0; i < field_patch; ++i) {
        const std::size_t at = pixel(x + i, y + j);
        if (left_[at] == 0) continue;
        left_[at] = 0;
        confidence_[at] = trust;
        from_[at] = {origin.x + i, origin.y + j};
        set_canvas((x + i) % size_.width, (y + j) % size_.height,
                   source_.features.at(origin.x + i, origin.y + j));
      }
    const Size field = hole_.field.size;
    const bool wraps_x = tiles_x(hole_.field.tile), wraps_y = tiles_y(hole_.field.tile);
    for (int v = y - patch_border - 1; v <= y + patch_border + 1; ++v)
      for (int u = x - patch_border - 1; u <= x + patch_border + 1; ++u) {
        const int column = wraps_x ? wrapped(u, field.width) : u;
        const int row = wraps_y ? wrapped(v, field.height) : v;
        if (column >= 0 && row >= 0 && column < field.width && row < field.height) ask(column, row);
      }
  }

  /// Sets a pixel and its repetitions behind the last ones.
  void set_canvas(int x, int y, const float* value) {
    for (int v = y; v < hole_.canvas.height; v += size_.height)
      for (int u = x; u < hole_.canvas.width; u += size_.width)
        std::copy_n(value, field_features, hole_.canvas.at(u, v));
  }

  /// The usable origin by which a patch has a pixel from where that was copied.
  bool origin_by(int x, int y, int i, int j, PatchOrigin& origin) const {
    const PatchOrigin from = from_[pixel(x + i, y + j)];
    const Size all = source_.origins();
    origin = {from.x - i, from.y - j};
    return from.x >= 0 && origin.x >= 0 && origin.y >= 0 && origin.x < all.width &&
           origin.y < all.height && source_.is_usable(origin);
  }

  void set_field(Random& random) {
    PatchField& field = hole_.field;
    for (int y = 0; y < field.size.height; ++y)
      for (int x = 0; x < field.size.width; ++x) {
        const std::size_t patch = field.index(x, y);
        if (!field.looks_for(patch)) continue;
        PatchOrigin origin;
        bool found = origin_by(x, y, middle, middle, origin);
        for (int k = 0; k < field_patch * field_patch && !found; ++k)
          found = origin_by(x, y, k % field_patch, k / field_patch, origin);
        if (!found) origin = origins_[random.below(static_cast<std::uint32_t>(origins_.size()))];
        field.nearest[patch] = origin;
      }
  }

  PatchHole& hole_;
  const PatchSource& source_;
  const GrowthPlaces& places_;
  const std::vector<PatchOrigin>& origins_;
  Size size_;
  std::vector<unsigned char> left_;  // pixels yet to be made
  std::vector<float> confidence_;
  std::vector<PatchOrigin> from_;
  std::vector<float> costs_;
  std::priority_queue<Turn> queue_;
};

}  // namespace

void grow(PatchHole& hole, const GrowthPlaces& places, float tolerance, Random random) {
  Growth(hole, places).run(tolerance, random);
}

}  // namespace gramloom
