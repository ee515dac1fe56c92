#include <algorithm>
#include <optional>

#include "classic/pixel_algorithms.h"

namespace gramloom::pixel {
namespace {

/// The level above: finished, and compared in full.
struct Parent {
  const Level& level;
  const Canvas& canvas;
  Reference reference;
  int radius;
};

int floor_half(int value, int ratio) {
  return ratio == 1 ? value : (value >= 0 ? value / 2 : (value - 1) / 2);
}

/// Synthesis of one level in scan order.
class Scan {
 public:
  Scan(const PixelParams& params, const Level& level, const Aim& aim, const Parent* parent,
       Canvas& canvas, Random random)
      : params_(params),
        level_(level),
        aim_(aim),
        parent_(parent),
        reference_(level, params.radius),
        random_(random),
        canvas_(canvas),
        known_(canvas.source.size(), true) {
    if (params.search == PixelSearch::coherence && parent)
      similar_ = make_similar(params, level, random.stream(1));
  }

  /// whole: compare the whole square about the pixel, not the causal half.
  void choose(int x, int y, bool whole) {
    Random random = random_.stream(2 * canvas_.index(x, y) + whole + 2);
    const auto about = neighbourhood(x, y, whole);
    const auto above = parent_ ? parents(x, y) : std::vector<Known>{};
    const auto weight = static_cast<float>(std::max<std::size_t>(1, about.size() + above.size()));
    // The coarsest level is small, and all others follow it: it is always searched in full.
    if (params_.search == PixelSearch::coherence && parent_) {
      const auto candidates = coherent_candidates(canvas_, known_, level_, similar_, x, y);
      std::vector<float> errors;
      for (const Point p : candidates) {
        errors.push_back(reference_.error(about, p) +
                         parent_->reference.error(above, parent_sample(p, x, y)));
        if (!aim_.guide.empty())
          errors.back() += weight * aim_.guide_error(level_, level_.index(p), x, y);
      }
      if (fits_at_all(errors, about)) {
        canvas_.at(x, y) = candidates[pick(errors, params_.tolerance, random)];
        return;
      }
    }
    auto errors = reference_.errors(about);
    if (parent_) add_parent_errors(parent_->reference.errors(above), x, y, errors);
    add_direction(level_, aim_, x, y, weight, errors);
    canvas_.at(x, y) = level_.point(static_cast<int>(pick(errors, params_.tolerance, random)));
  }

  /// Where the scan did not know the pixels beyond the seam yet, and goes over the result again.
  bool near_seam(int x, int y) const {
    const int band = 2 * params_.radius;
    return (tiles_x(canvas_.tile) && (x < band || x >= canvas_.size.width - band)) ||
           (tiles_y(canvas_.tile) && (y < band || y >= canvas_.size.height - band));
  }

 private:
  /// The L-shaped stencil (whole rows above, and the left part of the pixel's own), or the whole
  /// square about the pixel.
  std::vector<Known> neighbourhood(int x, int y, bool whole) const {
    std::vector<Known> found;
    for (int dy = -params_.radius; dy <= params_.radius; ++dy)
      for (int dx = -params_.radius; dx <= params_.radius; ++dx) {
        if (dy == 0 && dx == 0) {
          if (whole) continue;
          return found;
        }
        int near_x = x + dx, near_y = y + dy;
        if (!canvas_.wrap(near_x, near_y)) continue;
        const Point p = canvas_.at(near_x, near_y);
        found.push_back({reference_.offset(dx, dy), 1.0f, level_.colours.at(p.x, p.y)});
      }
    return found;
  }

  std::vector<Known> parents(int x, int y) const {
    std::vector<Known> found;
    for (int dy = -parent_->radius; dy <= parent_->radius; ++dy)
      for (int dx = -parent_->radius; dx <= parent_->radius; ++dx) {
        int near_x = x / 2 + dx, near_y = y / 2 + dy;
        if (!parent_->canvas.wrap(near_x, near_y)) continue;
        const Point p = parent_->canvas.at(near_x, near_y);
        found.push_back(
            {parent_->reference.offset(dx, dy), 1.0f, parent_->level.colours.at(p.x, p.y)});
      }
    return found;
  }

  /// Where the parent of pixel (x, y) would come from, if (x, y) came from p.
  Point parent_sample(Point p, int x, int y) const {
    const int ratio = parent_->level.ratio;
    return parent_->level.nearest({floor_half(p.x - x % 2 * level_.step, ratio),
                                   floor_half(p.y - y % 2 * level_.step, ratio)});
  }

  void add_parent_errors(const std::vector<float>& above, int x, int y,
                         std::vector<float>& errors) const {
    for (std::size_t i = 0; i < errors.size(); ++i)
      errors[i] += above[static_cast<std::size_t>(
          parent_->level.index(parent_sample(level_.point(static_cast<int>(i)), x, y)))];
  }

  const PixelParams& params_;
  const Level& level_;
  const Aim& aim_;
  const Parent* parent_;
  Reference reference_;
  Random random_;
  Canvas& canvas_;
  std::vector<bool> known_;
  Similar similar_;
};

}  // namespace

Canvas wei_levoy(const PixelParams& params, const Task& task, Random random,
                 const Control& control) {
  const int count = level_count(params.levels, task.exemplar.image.size(), task.size);
  auto levels = make_levels(task.exemplar.image, count);
  const std::vector<Aim> aims = direct(levels, task, params.radius);
  Canvas canvas(aims.back().size, task.tile);
  for (std::size_t i = 0; i < canvas.source.size(); ++i)
    canvas.source[i] = levels.back().nearest_usable(levels.back().point(static_cast<int>(
        random.stream(i).below(static_cast<std::uint32_t>(levels.back().count())))));

  std::int64_t all = 0, done = 0;
  for (int l = 0; l < count; ++l) all += aims[static_cast<std::size_t>(l)].size.height;
  Canvas coarser = canvas;
  for (int l = count - 1; l >= 0; --l) {
    const auto i = static_cast<std::size_t>(l);
    std::optional<Parent> parent;
    if (l < count - 1) {
      coarser = std::move(canvas);
      canvas = refined(coarser, levels[i + 1], levels[i], aims[i].size);
      const int radius = (params.radius + 1) / 2;
      parent.emplace(Parent{levels[i + 1], coarser, Reference(levels[i + 1], radius), radius});
    }
    Scan scan(params, levels[i], aims[i], parent ? &*parent : nullptr, canvas,
              random.stream((std::uint64_t{1} << 40) + i));
    for (int y = 0; y < canvas.size.height; ++y) {
      control.step(done++, all);
      for (int x = 0; x < canvas.size.width; ++x) scan.choose(x, y, false);
    }
    for (int y = 0; y < canvas.size.height; ++y) {
      control.step(done, all);
      for (int x = 0; x < canvas.size.width; ++x)
        if (scan.near_seam(x, y)) scan.choose(x, y, true);
    }
  }
  control.step(all, all);
  return canvas;
}

}  // namespace gramloom::pixel
