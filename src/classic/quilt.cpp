#include "classic/quilt.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "classic/overlap.h"
#include "classic/patch_reuse.h"
#include "classic/seam.h"
#include "core/simd.h"
#include "core/threads.h"

namespace gramloom {

namespace {

std::size_t to_size(int value) { return static_cast<std::size_t>(value); }

/// Buffers that patches laid at the same time borrow and give back, so that there are only as many
/// as threads.
class Buffers {
 public:
  std::vector<float> borrow() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    std::vector<float> buffer = std::move(free_.back());
    free_.pop_back();
    return buffer;
  }
  void give_back(std::vector<float> buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<float>> free_;
};

struct Work {
  const QuiltRules& rules;
  const Image& exemplar;
  const PatchAxis& x;
  const PatchAxis& y;
  OverlapErrors overlap_errors;
  PatchReuse reuse;
  const QuiltGuide* guide;
  Image canvas;
  SourceMap source;
  Buffers buffers;

  Size patch() const { return {x.patch, y.patch}; }
};

/// Where a patch comes from, and the error of its overlap over that of patches chosen blindly.
struct Choice {
  PatchOrigin origin;
  float error = 0;
};

/// A patch that could be laid.
struct Candidate {
  PatchOrigin origin;
  float error = 0;  // of its overlap, over that of patches chosen blindly
  Image pixels;
  Cut cut;
};

GRAMLOOM_SIMD float smallest(const std::vector<float>& values) {
  constexpr std::size_t lanes = 16;
  float low[lanes];
  std::fill_n(low, lanes, values[0]);
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes)
    for (std::size_t k = 0; k < lanes; ++k)
      low[k] = values[i + k] < low[k] ? values[i + k] : low[k];
  for (; i < values.size(); ++i) low[0] = std::min(low[0], values[i]);
  return *std::min_element(low, low + lanes);
}

GRAMLOOM_SIMD int count_up_to(const float* values, int count, float limit) {
  int found = 0;
  for (int i = 0; i < count; ++i) found += values[i] <= limit ? 1 : 0;
  return found;
}

/// One of the positions whose error is at most `limit`, all equally likely; there is one.
PatchOrigin draw(const std::vector<float>& errors, int width, float limit, Random& random) {
  std::vector<int> found;  // in each row of positions
  for (auto row = errors.begin(); row != errors.end(); row += width)
    found.push_back(count_up_to(&*row, width, limit));
  std::uint32_t all = 0;
  for (const int n : found) all += static_cast<std::uint32_t>(n);
  int rank = static_cast<int>(random.below(all));
  PatchOrigin position;
  while (rank >= found[static_cast<std::size_t>(position.y)])
    rank -= found[static_cast<std::size_t>(position.y++)];
  const float* row = errors.data() + static_cast<std::ptrdiff_t>(position.y) * width;
  while (row[position.x] > limit || rank-- > 0) ++position.x;
  return position;
}

PatchOrigin anywhere(Size positions, Random& random) {
  return {static_cast<int>(random.below(static_cast<std::uint32_t>(positions.width))),
          static_cast<int>(random.below(static_cast<std::uint32_t>(positions.height)))};
}

/// The one with the best cut of several patches whose errors are nearly the least.
Candidate choose(Work& work, const Image& old, PatchOrigin place, const Sides& sides,
                 Random& random) {
  const Size positions = work.overlap_errors.positions();
  const Size patch = work.patch();
  const auto candidate = [&](PatchOrigin origin, float error) {
    Candidate result{origin, error, under(work.exemplar, origin.x, origin.y, patch), {}};
    result.cut = cut(old, result.pixels, sides);
    return result;
  };
  if (!sides.any() && !work.guide) return candidate(anywhere(positions, random), 0);
  std::vector<float> errors = work.buffers.borrow();
  work.overlap_errors.compute(old, sides, errors);
  const float scale = work.overlap_errors.scale(sides);
  work.reuse.add_to(errors, static_cast<float>(work.rules.variety) * scale);
  if (work.guide)
    work.guide->add_to(errors, positions, place, work.canvas.size(),
                       static_cast<float>(work.rules.guidance));
  const float limit = (1 + static_cast<float>(work.rules.tolerance)) * smallest(errors) +
                      work.overlap_errors.noise(sides);
  Candidate best;
  for (int i = 0; i < work.rules.candidates; ++i) {
    const PatchOrigin origin = draw(errors, positions.width, limit, random);
    const float error = errors[to_size(origin.y) * to_size(positions.width) + to_size(origin.x)];
    Candidate next = candidate(origin, scale > 0 ? error / scale : 0);
    if (i == 0 || next.cut.error < best.cut.error) best = std::move(next);
  }
  work.buffers.give_back(std::move(errors));
  return best;
}

/// Lays a patch and returns where it comes from.
Choice lay(Work& work, const PatchSlot& slot, Random random) {
  const int left = work.x.starts[to_size(slot.column)];
  const int top = work.y.starts[to_size(slot.row)];
  const Size patch = work.patch();
  const Image old = under(work.canvas, left, top, patch);
  const Candidate chosen = choose(work, old, {left, top}, slot.sides, random);
  const Image& fresh = chosen.pixels;
  const std::vector<float> weights =
      feathered(chosen.cut.mask, patch, slot.sides, work.rules.feather);
  std::size_t i = 0;
  for (int y = 0; y < patch.height; ++y)
    for (int x = 0; x < patch.width; ++x, ++i) {
      const int column = (left + x) % work.canvas.width, row = (top + y) % work.canvas.height;
      if (weights[i] >= 0.5f)
        *work.source.at(column, row) = {chosen.origin.x + x, chosen.origin.y + y};
      float* pixel = work.canvas.at(column, row);
      const float *from = old.at(x, y), *to = fresh.at(x, y);
      for (int c = 0; c < old.channels; ++c)
        pixel[c] = weights[i] >= 1 ? to[c]
                   : weights[i] <= 0
                       ? from[c]
                       : std::clamp(from[c] + weights[i] * (to[c] - from[c]),
                                    std::min(from[c], to[c]), std::max(from[c], to[c]));
    }
  return {chosen.origin, chosen.error};
}

}  // namespace

Quilt lay_quilt(const Image& exemplar, const PatchAxis& x, const PatchAxis& y,
                const QuiltRules& rules, const QuiltGuide* guide, Random random,
                const std::function<void(std::int64_t laid)>& report) {
  OverlapErrors overlap_errors(exemplar, {x.patch, y.patch});
  PatchReuse reuse(overlap_errors.positions(), {x.patch, y.patch});
  Work work{rules,
            exemplar,
            x,
            y,
            std::move(overlap_errors),
            std::move(reuse),
            guide,
            Image(x.length, y.length, exemplar.channels),
            SourceMap({x.length, y.length}),
            {}};
  double error = 0;
  std::int64_t laid = 0;
  for (const std::vector<PatchSlot>& wave : waves(x, y)) {
    std::vector<Choice> choices(wave.size());
    parallel_for(static_cast<std::int64_t>(wave.size()), 1, [&](std::int64_t i, std::int64_t) {
      const PatchSlot& slot = wave[static_cast<std::size_t>(i)];
      choices[static_cast<std::size_t>(i)] =
          lay(work, slot,
              random.stream(static_cast<std::uint64_t>(slot.row * x.count() + slot.column)));
    });
    for (const Choice& choice : choices) {
      work.reuse.add(choice.origin);
      error += choice.error;
    }
    laid += static_cast<std::int64_t>(wave.size());
    report(laid);
  }
  return {std::move(work.canvas), std::move(work.source), error / static_cast<double>(laid)};
}

Image best_quilt(const Image& exemplar, const PatchAxis& x, const PatchAxis& y,
                 const QuiltRules& rules, int attempts, Random random) {
  std::vector<Quilt> quilts(to_size(attempts));
  parallel_for(attempts, 1, [&](std::int64_t i, std::int64_t) {
    quilts[static_cast<std::size_t>(i)] =
        lay_quilt(exemplar, x, y, rules, nullptr, random.stream(static_cast<std::uint64_t>(i)),
                  [](std::int64_t) {});
  });
  return std::move(std::ranges::min_element(quilts, {}, &Quilt::error)->canvas);
}

}  // namespace gramloom
