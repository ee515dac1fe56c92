#include "classic/quilt.h"

#include <algorithm>
#include <utility>

#include "classic/overlap.h"
#include "classic/patch_reuse.h"
#include "classic/quilt_choice.h"
#include "classic/seam.h"
#include "core/threads.h"

namespace gramloom {

namespace {

struct QuiltWork {
  const QuiltRules& rules;
  const QuiltMaterial& material;
  const PatchAxis& x;
  const PatchAxis& y;
  OverlapErrors overlap_errors;
  PatchReuse reuse;
  ExemplarQuota quota;
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
  PatchCut cut;
};

PatchOrigin anywhere(Size positions, Random& random) {
  return {static_cast<int>(random.below(static_cast<std::uint32_t>(positions.width))),
          static_cast<int>(random.below(static_cast<std::uint32_t>(positions.height)))};
}

/// errors += scale · what each exemplar's places cost.
void add_quota(const QuiltWork& work, float scale, std::vector<float>& errors) {
  if (work.quota.empty()) return;
  const std::vector<float> costs = work.quota.costs();
  const int width = work.overlap_errors.positions().width;
  std::vector<float> of_column;
  for (int u = 0; u < width; ++u)
    of_column.push_back(scale * costs[work.quota.exemplar_at(u * work.material.quota_factor)]);
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] += of_column[i % static_cast<std::size_t>(width)];
}

/// The errors of all positions, and up to which of them patches are drawn.
float find_errors(QuiltWork& work, const Image& old, PatchOrigin place, const Sides& sides,
                  std::vector<float>& errors) {
  const Size patch = work.patch();
  const auto tolerance = static_cast<float>(work.rules.tolerance);
  work.overlap_errors.compute(old, sides, errors);
  const float scale = work.overlap_errors.scale(sides);
  work.reuse.add_to(errors, static_cast<float>(work.rules.variety) * scale);
  if (work.material.guide)
    work.material.guide->add_to(errors, work.overlap_errors.positions(), place, work.canvas.size(),
                                static_cast<float>(work.rules.guidance));
  add_quota(work, scale, errors);
  if (!work.material.direction)
    return (1 + tolerance) * least_error(errors).error + work.overlap_errors.noise(sides);
  // What a patch must be for the guide's sake is not what another may be worse by.
  const Sides counted = sides.any() ? sides : Sides{patch.width, 0, 0, 0};
  const DirectedErrors directed =
      add_direction(*work.material.direction, place,
                    {work.overlap_errors.scale(counted), {}, sides.any()}, errors, work.buffers);
  return directed.least + tolerance * directed.own + work.overlap_errors.noise(counted);
}

/// The one with the best cut of several patches whose errors are nearly the least.
Candidate choose(QuiltWork& work, const Image& old, PatchOrigin place, const Sides& sides,
                 Random& random) {
  const Size positions = work.overlap_errors.positions();
  const Size patch = work.patch();
  const auto candidate = [&](PatchOrigin origin, float error) {
    Candidate result{origin, error, under(work.material.exemplar, origin.x, origin.y, patch), {}};
    result.cut = cut(old, result.pixels, sides);
    return result;
  };
  if (!sides.any() && !work.material.guide && !work.material.direction)
    return candidate(anywhere(positions, random), 0);
  std::vector<float> errors = work.buffers.borrow();
  const float limit = find_errors(work, old, place, sides, errors);
  const float scale = work.overlap_errors.scale(sides);
  Candidate best;
  for (int i = 0; i < work.rules.candidates; ++i) {
    const PatchOrigin origin = draw_up_to(errors, positions.width, limit, random);
    const float error = errors[to_size(origin.y) * to_size(positions.width) + to_size(origin.x)];
    Candidate next = candidate(origin, scale > 0 ? error / scale : 0);
    if (i == 0 || next.cut.error < best.cut.error) best = std::move(next);
  }
  work.buffers.give_back(std::move(errors));
  return best;
}

/// Lays a patch and returns where it comes from.
Choice lay(QuiltWork& work, const PatchSlot& slot, Random random) {
  const int left = work.x.starts[to_size(slot.column)];
  const int top = work.y.starts[to_size(slot.row)];
  const Size patch = work.patch();
  const Image old = under(work.canvas, left, top, patch);
  const Candidate chosen = choose(work, old, {left, top}, slot.sides, random);
  const std::vector<float> weights =
      feathered(chosen.cut.mask, patch, slot.sides, work.rules.feather);
  lay_pixels(old, chosen.pixels, chosen.origin, weights, {left, top}, work.canvas, work.source);
  return {chosen.origin, chosen.error};
}

}  // namespace

Quilt lay_quilt(const QuiltMaterial& material, const PatchAxis& x, const PatchAxis& y,
                const QuiltRules& rules, Random random, const QuiltReport& report) {
  OverlapErrors overlap_errors(material.exemplar, {x.patch, y.patch});
  PatchReuse reuse(overlap_errors.positions(), {x.patch, y.patch});
  QuiltWork work{rules,
                 material,
                 x,
                 y,
                 std::move(overlap_errors),
                 std::move(reuse),
                 material.quota,
                 Image(x.length, y.length, material.exemplar.channels),
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
      if (!work.quota.empty())
        work.quota.add(work.quota.exemplar_at(choice.origin.x * material.quota_factor),
                       1.0 / (x.count() * y.count()));
      error += choice.error;
    }
    laid += static_cast<std::int64_t>(wave.size());
    report(laid);
  }
  return {std::move(work.canvas), std::move(work.source), error / static_cast<double>(laid)};
}

}  // namespace gramloom
