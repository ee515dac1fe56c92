#include "classic/quilting.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "classic/patch_features.h"
#include "classic/patch_grid.h"
#include "classic/quilt.h"
#include "core/threads.h"

namespace gramloom {

namespace {

/// Below this, in pixels of the guide, its patches would show nothing.
constexpr int smallest_guide_patch = 5;
constexpr int attempts = 8;

int patch_side(const QuiltingParams& params, Size exemplar) {
  return params.patch_size > 0 ? params.patch_size
                               : std::max(1, std::min(exemplar.width, exemplar.height) * 3 / 8);
}

PatchAxis cover_axis(int patch, double part, int exemplar, int length, bool wraps) {
  patch = std::min(patch, std::max(1, exemplar * 3 / 4));
  const int overlap = static_cast<int>(part * patch + 0.5);
  return cover(length, patch, std::max(overlap, part > 0 ? 1 : 0), wraps);
}

struct Grid {
  PatchAxis x, y;
  Size patch() const { return {x.patch, y.patch}; }
};

Grid make_grid(const QuiltingParams& params, int patch, Size exemplar, const Target& target) {
  return {
      cover_axis(patch, params.overlap, exemplar.width, target.size.width, tiles_x(target.tile)),
      cover_axis(patch, params.overlap, exemplar.height, target.size.height, tiles_y(target.tile))};
}

/// The best of several quilts at a quarter of the resolution; none where that is too small.
std::optional<QuiltGuide> make_guide(const QuiltingParams& params, const Image& exemplar,
                                     const Grid& grid, const Target& target, Random random) {
  constexpr int factor = QuiltGuide::factor;
  const int patch = patch_side(params, exemplar.size()) / factor;
  const int smallest = std::min({patch, grid.x.patch / factor, grid.y.patch / factor});
  if (params.guidance == 0 || smallest < smallest_guide_patch) return std::nullopt;
  const Image quarter = halved(halved(exemplar));
  const Target small{{target.size.width / factor, target.size.height / factor}, target.tile};
  const Grid coarse = make_grid(params, patch, quarter.size(), small);
  const QuiltRules rules{.tolerance = params.tolerance, .variety = params.variety};
  return QuiltGuide(quarter, best_quilt(quarter, coarse.x, coarse.y, rules, attempts, random),
                    grid.patch());
}

}  // namespace

Texture synthesise(const QuiltingParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<QuiltingParams>(request);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  const Grid grid = make_grid(params, patch_side(params, exemplar.size()), exemplar.size(), target);
  const QuiltRules rules{params.tolerance, params.candidates, params.variety, params.guidance,
                         params.feather};
  const std::int64_t patches = std::int64_t{grid.x.count()} * grid.y.count();
  control.step(0, patches);
  const auto guide = make_guide(params, exemplar, grid, target, request.random.stream(0));
  Quilt quilt =
      lay_quilt(exemplar, grid.x, grid.y, rules, guide ? &*guide : nullptr,
                request.random.stream(1), [&](std::int64_t laid) { control.step(laid, patches); });
  return {std::move(quilt.canvas), {}, std::move(quilt.source)};
}

Cost estimate(const QuiltingParams& params, const RequestSize& request) {
  check_request<QuiltingParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const auto [x, y] =
      make_grid(params, patch_side(params, exemplar), exemplar, {request.size, request.tile});
  const double pixels = static_cast<double>(exemplar.width) * exemplar.height;
  const double result = static_cast<double>(request.size.width) * request.size.height;
  const double patches = static_cast<double>(x.count()) * y.count();
  const double overlap = x.before(x.count() - 1) + y.before(y.count() - 1);
  const double cuts = overlap * (x.patch + y.patch) * (channels + 3) * params.candidates;
  const double guide = params.guidance > 0 ? attempts / 16.0 : 0;  // in quilts
  return {.bytes = 4 * channels * (5 * pixels + result + guide * result) + sizeof(Source) * result +
                   (8 + 4.0 * thread_count()) * pixels,
          .seconds =
              patches * (pixels * (8 + 0.25 * overlap * channels) * (1 + guide / 4) + cuts) * 1e-9};
}

}  // namespace gramloom
