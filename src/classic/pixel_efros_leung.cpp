#include <algorithm>
#include <numeric>

#include "classic/pixel_algorithms.h"
#include "classic/pixel_features.h"

namespace gramloom::pixel {
namespace {

/// A result that grows pixel by pixel.
class Growth {
 public:
  Growth(const PixelParams& params, const Task& task, Random random)
      : params_(params),
        levels_(make_levels(task.exemplar.image, 1)),
        aim_(std::move(direct(levels_, task, params.radius).front())),
        level_(levels_.front()),
        reference_(level_, params.radius),
        weights_(gaussian_weights(params.radius)),
        random_(random),
        canvas_(task.size, task.tile),
        known_(canvas_.source.size(), false),
        copied_(known_) {
    if (params.search == PixelSearch::coherence)
      similar_ = make_similar(params, level_, random.stream(seed_streams));
  }

  /// What is known already; else 3×3 pixels of the exemplar, from anywhere, in the middle. Of a
  /// guide or a mask, one pixel that they allow.
  void plant() {
    for (std::size_t i = 0; i < known_.size(); ++i) known_[i] = !aim_.is_made(i);
    bool any = false;
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (known_[i]) {
        any = true;
        canvas_.source[i] = level_.nearest_usable({0, 0});
        touch(x_of(i), y_of(i));
      }
    if (any) return;
    if (!aim_.guide.empty() || !level_.usable.empty())
      grow(canvas_.index(tiles_x(canvas_.tile) ? 0 : canvas_.size.width / 2,
                         tiles_y(canvas_.tile) ? 0 : canvas_.size.height / 2));
    else
      plant_piece();
  }

  /// The unknown pixels next to known ones: those with most known neighbours first, equals at
  /// random.
  std::vector<std::size_t> front() {
    struct Entry {
      std::size_t pixel;
      std::size_t neighbours;
      std::uint32_t lot;
    };
    std::vector<Entry> entries;
    for (const std::size_t pixel : std::exchange(edge_, {}))
      if (!known_[pixel])
        entries.push_back({pixel, neighbourhood(pixel).size(), random_.stream(pixel).bits()});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::tuple(b.neighbours, a.lot, a.pixel) < std::tuple(a.neighbours, b.lot, b.pixel);
    });
    std::vector<std::size_t> pixels;
    for (const Entry& entry : entries)
      if (pixels.empty() || pixels.back() != entry.pixel) pixels.push_back(entry.pixel);
    return pixels;
  }

  void grow(std::size_t pixel) {
    Random random = random_.stream(pixel);
    const auto near = neighbourhood(pixel);
    float weight = near.empty() ? 1 : 0;
    for (const Known& known : near) weight += known.weight;
    const int x = x_of(pixel), y = y_of(pixel);
    if (params_.search == PixelSearch::coherence) {
      const auto candidates = coherent_candidates(canvas_, copied_, level_, similar_, x, y);
      std::vector<float> errors;
      for (const Point p : candidates) {
        errors.push_back(reference_.error(near, p));
        if (!aim_.guide.empty())
          errors.back() += weight * aim_.guide_error(level_, level_.index(p), x, y);
      }
      if (fits_at_all(errors, near)) {
        fill(x, y, candidates[pick(errors, params_.tolerance, random)]);
        return;
      }
    }
    auto errors = reference_.errors(near);
    add_direction(level_, aim_, x, y, weight, errors);
    fill(x, y, level_.point(static_cast<int>(pick(errors, params_.tolerance, random))));
  }

  const Canvas& canvas() const { return canvas_; }

 private:
  static constexpr std::uint64_t seed_streams = std::uint64_t{1} << 40;  // beyond all pixels

  int x_of(std::size_t pixel) const {
    return static_cast<int>(pixel % static_cast<std::size_t>(canvas_.size.width));
  }
  int y_of(std::size_t pixel) const {
    return static_cast<int>(pixel / static_cast<std::size_t>(canvas_.size.width));
  }

  void plant_piece() {
    Random random = random_.stream(seed_streams + 1);
    const Size seed{std::min({3, level_.colours.width, canvas_.size.width}),
                    std::min({3, level_.colours.height, canvas_.size.height})};
    const auto at = [&](int room) {
      return static_cast<int>(random.below(static_cast<std::uint32_t>(room + 1)));
    };
    const Point from{at(level_.colours.width - seed.width),
                     at(level_.colours.height - seed.height)};
    // On the seam where the result tiles, so that the last pixels to meet lie elsewhere.
    const Point to{tiles_x(canvas_.tile) ? 0 : (canvas_.size.width - seed.width) / 2,
                   tiles_y(canvas_.tile) ? 0 : (canvas_.size.height - seed.height) / 2};
    for (int y = 0; y < seed.height; ++y)
      for (int x = 0; x < seed.width; ++x) fill(to.x + x, to.y + y, {from.x + x, from.y + y});
  }

  void fill(int x, int y, Point source) {
    canvas_.at(x, y) = source;
    known_[canvas_.index(x, y)] = copied_[canvas_.index(x, y)] = true;
    touch(x, y);
  }

  /// Unknown pixels beside a known one come to the edge.
  void touch(int x, int y) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        int near_x = x + dx, near_y = y + dy;
        if (canvas_.wrap(near_x, near_y) && !known_[canvas_.index(near_x, near_y)])
          edge_.push_back(canvas_.index(near_x, near_y));
      }
  }

  /// The known pixels about one, with Gaussian weights.
  std::vector<Known> neighbourhood(std::size_t pixel) const {
    std::vector<Known> found;
    auto weight = weights_.begin();
    for (int dy = -params_.radius; dy <= params_.radius; ++dy)
      for (int dx = -params_.radius; dx <= params_.radius; ++dx, ++weight) {
        int x = x_of(pixel) + dx, y = y_of(pixel) + dy;
        if (!canvas_.wrap(x, y) || !known_[canvas_.index(x, y)]) continue;
        const Point p = canvas_.at(x, y);
        found.push_back(
            {reference_.offset(dx, dy), *weight,
             copied_[canvas_.index(x, y)] ? level_.colours.at(p.x, p.y) : aim_.colours.at(x, y)});
      }
    return found;
  }

  const PixelParams& params_;
  std::vector<Level> levels_;  // one
  Aim aim_;
  const Level& level_;
  Reference reference_;
  std::vector<float> weights_;
  Random random_;
  Canvas canvas_;
  std::vector<bool> known_, copied_;  // copied ones have a source
  std::vector<std::size_t> edge_;     // pixels that were unknown when a neighbour became known
  Similar similar_;
};

}  // namespace

Canvas efros_leung(const PixelParams& params, const Task& task, Random random,
                   const Control& control) {
  Growth growth(params, task, random);
  growth.plant();
  const std::int64_t all = growth.canvas().count();
  const std::int64_t often = params.search == PixelSearch::exact ? 16 : 4096;
  std::int64_t done = 0;
  for (auto front = growth.front(); !front.empty(); front = growth.front())
    for (const std::size_t pixel : front) {
      if (done++ % often == 0) control.step(std::min(done, all), all);
      growth.grow(pixel);
    }
  control.step(all, all);
  return growth.canvas();
}

}  // namespace gramloom::pixel
