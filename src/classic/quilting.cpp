#include "classic/quilting.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "classic/quilt_labels.h"
#include "classic/quilt_task.h"
#include "core/threads.h"
#include "signal/fill_windows.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Below this, in pixels of the guide, its patches would show nothing.
constexpr int smallest_guide_patch = 5;
constexpr int attempts = 8;
/// Of holes and where there is no patch_size: large patches would hide much, and fit nowhere.
constexpr int largest_fill_patch = 64;

int patch_side(const QuiltingParams& params, Size exemplar, bool guided, bool known) {
  if (params.patch_size > 0) return params.patch_size;
  const int side = std::min(exemplar.width, exemplar.height);
  const int patch = std::max(1, guided ? side / 4 : side * 3 / 8);
  return known ? std::min(patch, largest_fill_patch) : patch;
}

PatchAxis cover_axis(int patch, double part, int exemplar, int length, bool wraps) {
  patch = std::min(patch, std::max(1, exemplar * 3 / 4));
  const int overlap = static_cast<int>(part * patch + 0.5);
  return cover(length, patch, std::max(overlap, part > 0 ? 1 : 0), wraps);
}

QuiltGrid make_grid(const QuiltingParams& params, int patch, Size exemplar, Size size, Tile tile) {
  return {cover_axis(patch, params.overlap, exemplar.width, size.width, tiles_x(tile)),
          cover_axis(patch, params.overlap, exemplar.height, size.height, tiles_y(tile))};
}

/// The one with the least error among `attempts` quilts.
Image best_quilt(const QuiltTask& task, const QuiltGrid& grid, const QuiltRules& rules,
                 Random random) {
  std::vector<Quilt> quilts(attempts);
  parallel_for(attempts, 1, [&](std::int64_t i, std::int64_t) {
    quilts[static_cast<std::size_t>(i)] =
        make_quilt(task, grid, rules, nullptr, random.stream(static_cast<std::uint64_t>(i)),
                   [](std::int64_t) {});
  });
  return std::move(std::ranges::min_element(quilts, {}, &Quilt::error)->canvas);
}

/// The best of several quilts at a quarter of the resolution; none where that is too small.
std::optional<QuiltGuide> make_guide(const QuiltingParams& params, const QuiltTask& task, int patch,
                                     const QuiltGrid& grid, Random random) {
  constexpr int factor = QuiltGuide::factor;
  patch /= factor;
  const int smallest = std::min({patch, grid.x.patch / factor, grid.y.patch / factor});
  if (params.guidance == 0 || smallest < smallest_guide_patch) return std::nullopt;
  const QuarterTask quarter(task);
  Size exemplar = quarter.exemplar.image.size();
  if (!quarter.exemplar.mask.empty()) {
    const int side = largest_usable_square(quarter.exemplar.mask);
    if (side * 3 / 4 < smallest_guide_patch) return std::nullopt;
    exemplar = {side, side};
  }
  const QuiltGrid coarse = make_grid(params, patch, exemplar, quarter.size, quarter.tile);
  const QuiltRules rules{.tolerance = params.tolerance, .variety = params.variety};
  return QuiltGuide(quarter.exemplar.image, best_quilt(quarter.task(), coarse, rules, random),
                    grid.patch());
}

Texture synthesise_whole(const QuiltingParams& params, const Request& request,
                         const Control& control) {
  const United united(request);
  const Target& target = request.target;
  const ExemplarQuota quota(request, united);
  const QuiltTask task{united.exemplar(), target.size,         target.tile,         target.known,
                       target.mask,       quota.guide(united), target.guide_weight, quota};
  const Size usable = usable_size(request.exemplars);
  const int patch = patch_side(params, usable, !task.guide.empty(), !task.known.empty());
  const QuiltGrid grid = make_grid(params, patch, usable, task.size, task.tile);
  const QuiltRules rules{params.tolerance, params.candidates, params.variety, params.guidance,
                         params.feather};
  const std::int64_t patches = std::int64_t{grid.x.count()} * grid.y.count();
  control.step(0, patches);
  const auto guide = make_guide(params, task, patch, grid, request.random.stream(0));
  std::int64_t done = 0;
  Quilt quilt = make_quilt(task, grid, rules, guide ? &*guide : nullptr, request.random.stream(1),
                           [&](std::int64_t laid) { control.step(done = laid, patches); });
  const auto go_on = [&](std::int64_t) { control.step(done, patches); };
  if (!task.known.empty())
    mend_rim(quilt, task, std::min(grid.x.patch, grid.y.patch), params.overlap, rules,
             request.random.stream(3), go_on);
  if (!task.guide.empty())
    keep_labels(quilt, {task.exemplar, task.guide, task.weight, task.tile}, task.mask, grid.patch(),
                params.overlap, rules, request.random.stream(2), go_on);
  if (done < patches) control.step(patches, patches);
  united.name_sources(quilt.source);
  return {std::move(quilt.canvas), {}, std::move(quilt.source)};
}

}  // namespace

Texture synthesise(const QuiltingParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<QuiltingParams>(request);
  const std::vector<FillWindow> windows =
      fill_windows(request, 4);  // a patch costs as much as where it is sought is large
  if (windows.empty()) return synthesise_whole(params, request, control);
  return fill_by_windows(
      request, windows,
      [&](const Request& part, const Control& own) { return synthesise_whole(params, part, own); },
      control);
}

Cost estimate(const QuiltingParams& params, const RequestSize& request) {
  check_request<QuiltingParams>(request);
  Size exemplar = request.exemplars.front().size;
  Size joined = exemplar;
  for (std::size_t i = 1; i < request.exemplars.size(); ++i) {
    const Size size = request.exemplars[i].size;
    joined = {joined.width + size.width, std::max(joined.height, size.height)};
    exemplar = {std::min(exemplar.width, size.width), std::min(exemplar.height, size.height)};
  }
  const int channels = request.exemplars.front().channels;
  const bool guided = request.guide || request.weights;
  const auto [x, y] = make_grid(params, patch_side(params, exemplar, guided, request.known),
                                exemplar, request.size, request.tile);
  const double pixels = static_cast<double>(joined.width) * joined.height;
  const double result = static_cast<double>(request.size.width) * request.size.height;
  const double patches = static_cast<double>(x.count()) * y.count();
  const double overlap = x.before(x.count() - 1) + y.before(y.count() - 1);
  const double cuts = overlap * (x.patch + y.patch) * (channels + 3) * params.candidates;
  const double guide = params.guidance > 0 ? attempts / 16.0 : 0;  // in quilts
  Cost cost{.bytes = 4 * channels * (5 * pixels + result + guide * result) +
                     sizeof(Source) * result + (8 + 4.0 * thread_count()) * pixels,
            .work = {.shared = patches *
                               (pixels * (8 + 0.25 * overlap * channels) * (1 + guide / 4) + cuts) *
                               7e-10}};
  // Two-dimensional transforms: spectra, and for each patch their products and a transform back.
  if (guided || request.known) {
    const double planes = (request.known ? channels + 1 : 0) + (guided ? 4 : 0);
    const double laid = patches * std::min(1.0, 2 * request.made);
    cost.bytes += 8 * planes * pixels + 16 * result;
    cost.work.shared = (request.known ? 0 : cost.work.shared) +
                       laid * (pixels * (20 + 4 * planes) + 40 * cuts) * (1 + guide / 4) * 1e-9;
  }
  return cost;
}

}  // namespace gramloom
