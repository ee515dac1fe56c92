#include "classic/patchmatch.h"

#include <malloc.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "classic/patch_features.h"
#include "classic/patch_levels.h"
#include "classic/patch_vote.h"
#include "classic/patchmatch_directed.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "signal/mirror.h"
#include "signal/patch_field.h"
#include "signal/patch_penalty.h"

namespace gramloom {

namespace {

/// Lower bound of the exemplar's shorter side on the coarsest level.
constexpr int coarsest_side = 28;

struct Level {
  Image exemplar;  // features
  Size texture;
  int iterations = 0;
};

/// Finest first.
std::vector<Level> make_levels(const PatchmatchParams& params, const Image& exemplar,
                               Size texture) {
  std::vector<Level> levels{
      {patch_features(exemplar, params.structure), texture, params.iterations}};
  const int count = level_count(params, exemplar.size(), texture);
  while (static_cast<int>(levels.size()) < count) {
    const Level& finer = levels.back();
    const Size half{(finer.texture.width + 1) / 2, (finer.texture.height + 1) / 2};
    Level next{halved(finer.exemplar), half, finer.iterations + more_iterations};
    levels.push_back(std::move(next));
  }
  return levels;
}

/// Number of patches in each direction that cover a texture.
Size patches_of(Size texture, Tile tile) {
  return {texture.width - (tiles_x(tile) ? 0 : patch_border),
          texture.height - (tiles_y(tile) ? 0 : patch_border)};
}

/// A canvas to start from: a quilt of the exemplar, repeated where it tiles. Patches of 12 pixels
/// on the coarsest level, a third of the exemplar, which overlap widely and match closely, keep
/// long rows straight.
Image first_canvas(const Level& level, Tile tile, Random random) {
  const QuiltingParams params{.patch_size = 12,
                              .overlap = 1.0 / 3,
                              .tolerance = 0.05,
                              .candidates = 1,
                              .variety = 0,
                              .guidance = 0};
  const Image quilt =
      synthesise(params, {{{level.exemplar}}, {level.texture, tile}, random}, {}).image;
  const Size patches = patches_of(level.texture, tile);
  Image canvas(patches.width + patch_border, patches.height + patch_border, field_features);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      std::copy_n(quilt.at(x % quilt.width, y % quilt.height), field_features, canvas.at(x, y));
  return canvas;
}

/// The field of a level from that of the next coarser one: each patch comes from where the patch
/// over it comes from.
PatchField refined(const PatchField& coarse, const Level& level) {
  const Size size = patches_of(level.texture, coarse.tile);
  const Size origins = patch_origins(level.exemplar.size());
  PatchField fine = blank_field(size, coarse.tile);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int cx = std::min(x / 2, coarse.size.width - 1);
      const int cy = std::min(y / 2, coarse.size.height - 1);
      const PatchOrigin o = coarse.nearest[coarse.index(cx, cy)];
      fine.nearest[fine.index(x, y)] = {std::clamp(2 * o.x + x - 2 * cx, 0, origins.width - 1),
                                        std::clamp(2 * o.y + y - 2 * cy, 0, origins.height - 1)};
    }
  return fine;
}

/// Few enough patches and origins to try all.
bool is_small(const Level& level) {
  return area(level.texture) * area(level.exemplar.size()) < 2e7;
}

/// The sources of a texture, cut from what was chosen, of this size: a pixel beyond the exemplar is
/// the mirror image of one inside.
SourceMap sources_of(const std::vector<SmallOrigin>& pixels, Size chosen, Size wanted,
                     Size exemplar) {
  SourceMap sources(wanted);
  for (int y = 0; y < wanted.height; ++y)
    for (int x = 0; x < wanted.width; ++x) {
      const PatchOrigin from =
          pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(chosen.width) +
                 static_cast<std::size_t>(x)];
      *sources.at(x, y) = {mirrored(from.x, exemplar.width), mirrored(from.y, exemplar.height)};
    }
  return sources;
}

}  // namespace

int level_count(const PatchmatchParams& params, Size exemplar, Size texture) {
  int count = 1;
  while (std::min(exemplar.width, exemplar.height) >> count >= coarsest_side &&
         std::min(texture.width, texture.height) >> count >= smallest_side)
    ++count;
  return params.levels > 0 ? std::min(count, params.levels) : count;
}

Texture synthesise(const PatchmatchParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<PatchmatchParams>(request);
  if (is_directed(size_of(request))) return directed_patchmatch(params, request, control);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  check_origins(exemplar.size());
  const Image source = at_least(exemplar, smallest_side);
  // A texture that does not tile may be cut from a larger one; one that tiles wraps at any size.
  const Size size{
      tiles_x(target.tile) ? target.size.width : std::max(target.size.width, smallest_side),
      tiles_y(target.tile) ? target.size.height : std::max(target.size.height, smallest_side)};
  std::vector<Level> levels = make_levels(params, source, size);
  Progress progress;
  for (const Level& level : levels) progress.steps += level.iterations;

  PatchField field;
  Image canvas;
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    const Size origins = patch_origins(level->exemplar.size());
    PatchPenalty penalty(patches_of(level->texture, target.tile), origins);
    if (level == levels.rbegin()) {
      field = random_field(penalty.field, target.tile, origins, request.random.stream(0));
      canvas = first_canvas(*level, target.tile, request.random.stream(1));
      if (is_small(*level)) search_all(field, canvas, level->exemplar, penalty);
    } else {
      field = refined(field, *level);
      canvas = {};
      canvas = vote(field, level->exemplar, equal_weights);
    }
    for (int i = 0; i < level->iterations; ++i) {
      improve(field, canvas, level->exemplar, penalty, i, params.tries,
              request.random.stream(2).stream(static_cast<std::uint64_t>(progress.step)));
      progress.loss = robust_energy(field, noise_floor);
      vote(field, level->exemplar, noise_floor, canvas);
      update(penalty, field, params.uniformity, params.largest_copy);
      ++progress.step;
      if (!control.report(progress)) throw Interrupted();
    }
  }
  // Of a large texture each of these takes gigabytes, and all at once are not needed. What is free
  // would stay with the process.
  field.distance = {};
  malloc_trim(0);
  const auto pixels = choose_pixels(field, canvas, levels.front().exemplar);
  field = {};
  canvas = {};
  levels.clear();
  malloc_trim(0);
  return texture_of(sources_of(pixels, size, target.size, exemplar.size()), request.exemplars);
}

Cost estimate(const PatchmatchParams& params, const RequestSize& request) {
  check_request<PatchmatchParams>(request);
  if (is_directed(request)) return estimate_directed(params, request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const auto area = [](double width, double height) { return width * height; };
  const double pixels = area(request.size.width, request.size.height);
  const double samples = area(exemplar.width, exemplar.height);
  const double counts = area(request.size.width + exemplar.width, exemplar.height + 96);
  // A level has a quarter of the work of the next finer one, but more iterations.
  const double iterations = params.iterations * 4.0 / 3 + more_iterations * 4.0 / 9;
  // A field, its canvas and penalties; or, at the end, origins, sources and their picture.
  const double bytes_per_pixel = std::max(28.0, 12 + 4.0 * channels);
  return {
      .bytes = pixels * bytes_per_pixel + samples * (48 + 4.0 * channels) + counts * 4,
      .work = {.serial = 0.1,
               .shared = pixels * iterations * (66 + 22.0 * params.tries) * 1e-9 + samples * 5e-7}};
}

}  // namespace gramloom
