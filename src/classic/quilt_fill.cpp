#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "classic/overlap_weighted.h"
#include "classic/patch_reuse.h"
#include "classic/quilt.h"
#include "classic/quilt_choice.h"
#include "classic/seam_graph.h"
#include "core/threads.h"

namespace gramloom {

namespace {

/// How much a pixel that stays counts beside one that may change.
constexpr float firm_weight = 4;

/// How much a pixel counts as overlap: 1 where it may change; where it may not, more beside those
/// that may, as no cut can hide what doesn't fit there, and less with its distance from them down
/// to 0 at `reach`. Axes that wrap do so here.
std::vector<float> overlap_weights(const std::vector<Ground>& ground, Size size, int reach,
                                   bool wraps_x, bool wraps_y) {
  cv::Mat1b firm(size.height, size.width), padded;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      firm(y, x) = ground[to_size(y) * to_size(size.width) + to_size(x)] == Ground::firm ? 1 : 0;
  const int across = wraps_x ? reach : 0, down = wraps_y ? reach : 0;
  cv::copyMakeBorder(firm, padded, down, down, across, across, cv::BORDER_WRAP);
  cv::Mat1f distance;
  cv::distanceTransform(padded, distance, cv::DIST_L2, cv::DIST_MASK_5);
  std::vector<float> result;
  result.reserve(ground.size());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float away = distance(y + down, x + across);
      const float near = std::max(0.0f, 1 - away / static_cast<float>(reach + 1));
      result.push_back(away > 0 ? firm_weight * near * near : 1);
    }
  return result;
}

/// Where a patch comes from, and its error over that of patches chosen blindly.
struct Laid {
  PatchOrigin origin;
  float error = 0;
};

class Filling {
 public:
  Filling(Quilt& quilt, std::vector<Ground> ground, const QuiltMaterial& material,
          const PatchAxis& x, const PatchAxis& y, const QuiltRules& rules)
      : quilt_(quilt),
        material_(material),
        x_(x),
        y_(y),
        rules_(rules),
        patch_{x.patch, y.patch},
        errors_(material.exemplar, patch_),
        reuse_(errors_.positions(), patch_),
        counts_(overlap_weights(ground, quilt.canvas.size(), std::max(x.patch, y.patch) / 2,
                                x.wraps, y.wraps)),
        ground_(std::move(ground)) {}

  /// Whether there is anything to be made under a patch.
  bool touches(const PatchSlot& slot) const {
    const PatchOrigin place = place_of(slot);
    for (int y = 0; y < patch_.height; ++y)
      for (int x = 0; x < patch_.width; ++x)
        if (ground_[index(place.x + x, place.y + y)] == Ground::bare) return true;
    return false;
  }

  Laid lay(const PatchSlot& slot, Random random);
  void remember(const Laid& laid) { reuse_.add(laid.origin); }

 private:
  struct Candidate {
    PatchOrigin origin;
    Image pixels;
    PatchCut cut;
  };

  PatchOrigin place_of(const PatchSlot& slot) const {
    return {x_.starts[to_size(slot.column)], y_.starts[to_size(slot.row)]};
  }
  std::size_t index(int x, int y) const {
    return to_size(y % y_.length) * to_size(x_.length) + to_size(x % x_.length);
  }
  std::vector<Ground> ground_under(PatchOrigin place) const;
  Candidate choose(const Image& old, PatchOrigin place, const std::vector<Ground>& ground,
                   Random& random, float& error);
  std::vector<float> weights_of(const PatchCut& cut, const std::vector<Ground>& ground) const;

  Quilt& quilt_;
  const QuiltMaterial& material_;
  const PatchAxis &x_, &y_;
  const QuiltRules& rules_;
  Size patch_;
  WeightedErrors errors_;
  PatchReuse reuse_;
  std::vector<float> counts_;   // a pixel of the quilt, as overlap
  std::vector<Ground> ground_;  // likewise
  Buffers buffers_;
};

/// With a line more on each side; beyond an edge that doesn't wrap it is bare.
std::vector<Ground> Filling::ground_under(PatchOrigin place) const {
  std::vector<Ground> ground;
  ground.reserve(to_size(patch_.width + 2) * to_size(patch_.height + 2));
  for (int y = place.y - 1; y <= place.y + patch_.height; ++y)
    for (int x = place.x - 1; x <= place.x + patch_.width; ++x) {
      const bool beyond =
          (!x_.wraps && (x < 0 || x >= x_.length)) || (!y_.wraps && (y < 0 || y >= y_.length));
      ground.push_back(beyond ? Ground::bare : ground_[index(x + x_.length, y + y_.length)]);
    }
  return ground;
}

Filling::Candidate Filling::choose(const Image& old, PatchOrigin place,
                                   const std::vector<Ground>& ground, Random& random,
                                   float& error) {
  const Size positions = errors_.positions();
  std::vector<float> counts, made;  // of each pixel: as overlap, and whether it may be taken
  float overlap = 0;
  for (int y = 0; y < patch_.height; ++y)
    for (int x = 0; x < patch_.width; ++x) {
      const Ground g = ground[to_size(y + 1) * to_size(patch_.width + 2) + to_size(x + 1)];
      counts.push_back(g == Ground::bare ? 0 : counts_[index(place.x + x, place.y + y)]);
      made.push_back(g == Ground::firm ? 0.0f : 1.0f);
      overlap += counts.back();
    }
  const auto variance = static_cast<float>(errors_.variance());
  const auto scale = variance * (overlap > 0 ? overlap : static_cast<float>(counts.size()));

  std::vector<float> errors = buffers_.borrow();
  errors.assign(to_size(positions.width) * to_size(positions.height), 0.0f);
  if (overlap > 0) errors_.add_to(errors, old, counts, 1);
  reuse_.add_to(errors, static_cast<float>(rules_.variety) * scale);
  if (material_.guide)
    material_.guide->add_to(errors, positions, place, quilt_.canvas.size(),
                            static_cast<float>(rules_.guidance));
  const auto tolerance = static_cast<float>(rules_.tolerance);
  float limit = 1e-5f * scale;
  if (material_.direction) {
    const DirectedErrors directed =
        add_direction(*material_.direction, place, {scale, made, overlap > 0}, errors, buffers_);
    limit += directed.least + tolerance * directed.own;
  } else {
    limit += (1 + tolerance) * least_error(errors).error;
  }
  Candidate best;
  for (int i = 0; i < rules_.candidates; ++i) {
    const PatchOrigin origin = draw_up_to(errors, positions.width, limit, random);
    Candidate next{origin, under(material_.exemplar, origin.x, origin.y, patch_), {}};
    next.cut = graph_cut(old, next.pixels, ground);
    if (i > 0 && next.cut.error >= best.cut.error) continue;
    best = std::move(next);
    error = errors[to_size(origin.y) * to_size(positions.width) + to_size(origin.x)];
  }
  error = scale > 0 ? error / scale : 0;
  buffers_.give_back(std::move(errors));
  return best;
}

/// The cut's mask, feathered where the ground is laid: averaged over (2 · feather + 1)² pixels.
std::vector<float> Filling::weights_of(const PatchCut& cut,
                                       const std::vector<Ground>& ground) const {
  std::vector<float> weights(cut.mask.begin(), cut.mask.end());
  if (rules_.feather == 0) return weights;
  const cv::Mat mask(patch_.height, patch_.width, CV_32F, weights.data());
  cv::Mat padded, means;
  cv::copyMakeBorder(mask, padded, rules_.feather, rules_.feather, rules_.feather, rules_.feather,
                     cv::BORDER_REPLICATE);
  const int side = 2 * rules_.feather + 1;
  cv::blur(padded, means, {side, side}, {-1, -1}, cv::BORDER_ISOLATED);
  for (int y = 0; y < patch_.height; ++y)
    for (int x = 0; x < patch_.width; ++x)
      if (ground[to_size(y + 1) * to_size(patch_.width + 2) + to_size(x + 1)] == Ground::laid)
        weights[to_size(y) * to_size(patch_.width) + to_size(x)] =
            means.at<float>(y + rules_.feather, x + rules_.feather);
  return weights;
}

Laid Filling::lay(const PatchSlot& slot, Random random) {
  const PatchOrigin place = place_of(slot);
  const Image old = under(quilt_.canvas, place.x, place.y, patch_);
  const std::vector<Ground> ground = ground_under(place);
  Laid laid;
  const Candidate chosen = choose(old, place, ground, random, laid.error);
  laid.origin = chosen.origin;
  lay_pixels(old, chosen.pixels, chosen.origin, weights_of(chosen.cut, ground), place,
             quilt_.canvas, quilt_.source);
  for (int y = 0; y < patch_.height; ++y)
    for (int x = 0; x < patch_.width; ++x) {
      Ground& g = ground_[index(place.x + x, place.y + y)];
      if (g == Ground::bare) g = Ground::laid;
    }
  return laid;
}

}  // namespace

void fill_quilt(Quilt& quilt, std::vector<Ground> ground, const QuiltMaterial& material,
                const PatchAxis& x, const PatchAxis& y, const QuiltRules& rules, Random random,
                const QuiltReport& report) {
  Filling filling(quilt, std::move(ground), material, x, y, rules);
  double error = 0;
  std::int64_t laid = 0;
  for (std::vector<PatchSlot> wave : waves(x, y)) {
    std::erase_if(wave, [&](const PatchSlot& slot) { return !filling.touches(slot); });
    if (wave.empty()) continue;
    std::vector<Laid> results(wave.size());
    parallel_for(static_cast<std::int64_t>(wave.size()), 1, [&](std::int64_t i, std::int64_t) {
      const PatchSlot& slot = wave[static_cast<std::size_t>(i)];
      results[static_cast<std::size_t>(i)] = filling.lay(
          slot, random.stream(static_cast<std::uint64_t>(slot.row * x.count() + slot.column)));
    });
    for (const Laid& result : results) {
      filling.remember(result);
      error += result.error;
    }
    laid += static_cast<std::int64_t>(wave.size());
    report(laid);
  }
  quilt.error = laid > 0 ? error / static_cast<double>(laid) : 0;
}

}  // namespace gramloom
