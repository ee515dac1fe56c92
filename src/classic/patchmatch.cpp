#include "classic/patchmatch.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "classic/patch_features.h"
#include "classic/patch_field.h"
#include "classic/patch_vote.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "core/threads.h"

namespace gramloom {

namespace {

/// Sides below this are too short for patches to find their like in.
constexpr int smallest_side = 2 * field_patch;
/// The exemplar's shorter side on the coarsest level.
constexpr int coarsest_side = 28;

constexpr float noise_floor = 1e-4f * field_patch * field_patch;

int automatic_levels(Size exemplar, Size texture) {
  int levels = 1;
  while (std::min(exemplar.width, exemplar.height) >> levels >= coarsest_side &&
         std::min(texture.width, texture.height) >> levels >= smallest_side)
    ++levels;
  return levels;
}

Size level_size(Size size, int level) {
  const int round_up = (1 << level) - 1;
  return {(size.width + round_up) >> level, (size.height + round_up) >> level};
}

/// The number of patches that cover a texture.
Size field_size(Size texture, Tile tile) {
  const int border = field_patch - 1;
  return {texture.width - (tiles_x(tile) ? 0 : border), texture.height - (tiles_y(tile) ? 0 : border)};
}

/// Origins of a level's field, each from the patch of the next coarser one over it.
PatchField refined(const PatchField& coarse, Size texture, Size exemplar) {
  const Size size = field_size(texture, coarse.tile), origins = patch_origins(exemplar);
  PatchField fine{size, coarse.tile, {}, {}};
  const auto count = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  fine.nearest.reserve(count);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const int cx = std::min(x / 2, coarse.size.width - 1);
      const int cy = std::min(y / 2, coarse.size.height - 1);
      const PatchOrigin o = coarse.nearest[coarse.index(cx, cy)];
      fine.nearest.push_back({std::clamp(2 * o.x + x - 2 * cx, 0, origins.width - 1),
                              std::clamp(2 * o.y + y - 2 * cy, 0, origins.height - 1)});
    }
  fine.distance.assign(count, 0.0f);
  return fine;
}

struct Level {
  Image exemplar;  // features
  Size texture;
  int iterations = 0;
};

Image padded(const Image& image, Size canvas) {
  Image result(canvas, image.channels);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      std::copy_n(image.at(x % image.width, y % image.height), image.channels, result.at(x, y));
  return result;
}

}  // namespace

Texture synthesise(const PatchmatchParams& params, const Image& original, const Target& target,
                   Random random, const Control& control) {
  check_fields(params);
  if (original.empty()) throw Error("patchmatch needs an exemplar with at least one pixel");
  if (target.size.width < 1 || target.size.height < 1)
    throw Error("a texture of {}×{} pixels cannot be made", target.size.width, target.size.height);
  const Image exemplar = at_least(original, smallest_side);
  Size size = target.size;
  if (!tiles_x(target.tile)) size.width = std::max(size.width, smallest_side);
  if (!tiles_y(target.tile)) size.height = std::max(size.height, smallest_side);
  int count = automatic_levels(exemplar.size(), size);
  if (params.levels > 0) count = std::min(count, params.levels);

  std::vector<Level> levels;  // finest first
  std::int64_t steps = 0, step = 0;
  for (int l = 0; l < count; ++l) {
    levels.push_back({l == 0 ? patch_features(exemplar) : halved(levels.back().exemplar),
                      level_size(size, l), params.iterations + 6 * l});
    steps += levels.back().iterations;
  }

  PatchField field;
  Image canvas;
  std::int64_t pass = 0;
  for (int l = count - 1; l >= 0; --l) {
    const Level& level = levels[static_cast<std::size_t>(l)];
    const Size origins = patch_origins(level.exemplar.size());
    const Size patches = field_size(level.texture, target.tile);
    if (l == count - 1) {
      field = random_field(patches, target.tile, level.exemplar.size(), random.stream(1));
      if (params.start_patch > 0) {
        QuiltingParams q;
        q.patch_size = params.start_patch;
        q.tolerance = 0.3;
        canvas = padded(synthesise(q, level.exemplar, {level.texture, target.tile}, random.stream(2), {}).image,
                        {patches.width + field_patch - 1, patches.height + field_patch - 1});
      } else {
        canvas = vote(field, level.exemplar, 1.0f);
      }
    } else {
      field = refined(field, level.texture, level.exemplar.size());
      canvas = vote(field, level.exemplar, 1.0f);
    }
    std::vector<float> penalty(static_cast<std::size_t>(origins.width) * static_cast<std::size_t>(origins.height));
    for (int i = 0; i < level.iterations; ++i, ++pass) {
      if (l == count - 1 && i < 2) search_all(field, canvas, level.exemplar, penalty);
      improve(field, canvas, level.exemplar, penalty, static_cast<int>(pass), params.tries,
              random.stream(3).stream(static_cast<std::uint64_t>(pass)));
      canvas = vote(field, level.exemplar, noise_floor);
      if (params.uniformity > 0) {
        const std::vector<float> used = usage(field, level.exemplar.size());
        const float scale = static_cast<float>(params.uniformity) * field_patch * field_patch;
        for (std::size_t k = 0; k < used.size(); ++k)
          penalty[k] = 0.5f * penalty[k] + 0.5f * scale * std::max(0.0f, used[k] - 1);
      }
      Progress progress;
      progress.step = ++step;
      progress.steps = steps;
      progress.loss = robust_energy(field, noise_floor);
      if (!control.report(progress)) throw Interrupted();
    }
  }

  Image result(target.size, exemplar.channels);
  const std::vector<PatchOrigin> pixels = choose_pixels(field, canvas, levels[0].exemplar);
  for (int y = 0; y < target.size.height; ++y)
    for (int x = 0; x < target.size.width; ++x) {
      const PatchOrigin o = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                   static_cast<std::size_t>(x)];
      std::copy_n(exemplar.at(o.x, o.y), exemplar.channels, result.at(x, y));
    }
  if (std::getenv("PM_MAP")) {
    Image map(target.size, 3);
    for (int y = 0; y < target.size.height; ++y)
      for (int x = 0; x < target.size.width; ++x) {
        const PatchOrigin o = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                   static_cast<std::size_t>(x)];
        map.at(x,y)[0] = static_cast<float>(o.x) / static_cast<float>(exemplar.width);
        map.at(x,y)[1] = static_cast<float>(o.y) / static_cast<float>(exemplar.height);
      }
    return {std::move(result), {{"map", map}}};
  }
  return {std::move(result), {}};
}

Cost estimate(const PatchmatchParams& params, Size exemplar, int channels, const Target& target) {
  (void)params;
  (void)exemplar;
  (void)channels;
  (void)target;
  return {};
}

}  // namespace gramloom
