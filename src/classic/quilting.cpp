#include "classic/quilting.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "classic/fill_windows.h"
#include "classic/patch_features.h"
#include "classic/patch_grid.h"
#include "classic/quilt.h"
#include "classic/quilt_labels.h"
#include "core/error.h"
#include "core/threads.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Below this, in pixels of the guide, its patches would show nothing.
constexpr int smallest_guide_patch = 5;
constexpr int attempts = 8;
/// Of holes and where there is no patch_size: large patches would hide much, and fit nowhere.
constexpr int largest_fill_patch = 64;
/// Of patches from anything smaller there would be as many as pixels.
constexpr int smallest_usable = 6;
/// Smaller ones would hold nothing of a texture.
constexpr int smallest_rim_patch = 12;

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

struct Grid {
  PatchAxis x, y;
  Size patch() const { return {x.patch, y.patch}; }
};

Grid make_grid(const QuiltingParams& params, int patch, Size exemplar, Size size, Tile tile) {
  return {cover_axis(patch, params.overlap, exemplar.width, size.width, tiles_x(tile)),
          cover_axis(patch, params.overlap, exemplar.height, size.height, tiles_y(tile))};
}

/// What is to be quilted: exemplars as one, and the parts of the target, of which any may be empty.
struct Task {
  const Exemplar& exemplar;
  Size size;
  Tile tile;
  const Image& known;
  const Image& mask;
  const Image& guide;
  const Image& weight;
  ExemplarQuota quota = {};
  int quota_factor = 1;  // as QuiltMaterial

  bool directed() const { return !exemplar.mask.empty() || !guide.empty(); }
};

/// A task at a quarter of its resolution. A pixel of the target is made there where any of those
/// under it is.
struct QuarterTask {
  Exemplar exemplar;
  Image known, mask, guide, weight;
  Size size;
  Tile tile;
  ExemplarQuota quota;

  explicit QuarterTask(const Task& task)
      : exemplar{quarter(task.exemplar.image),
                 {},
                 quarter_mask(task.exemplar.mask),
                 quarter(task.exemplar.guide)},
        known(quarter(task.known)),
        mask(inverse(quarter_mask(inverse(task.mask)))),
        guide(quarter(task.guide)),
        weight(task.weight.size() == task.size ? quarter(task.weight) : task.weight),
        size{task.size.width / QuiltGuide::factor, task.size.height / QuiltGuide::factor},
        tile(task.tile),
        quota(task.quota) {}

  Task task() const {
    return {exemplar, size, tile, known, mask, guide, weight, quota, QuiltGuide::factor};
  }

 private:
  static Image quarter(const Image& image) {
    return image.empty() ? Image{} : halved(halved(image));
  }
  static Image quarter_mask(const Image& mask) {
    return mask.empty() ? Image{} : halved_mask(halved_mask(mask));
  }
  static Image inverse(Image mask) {
    for (float& m : mask.pixels) m = m > 0.5f ? 0.0f : 1.0f;
    return mask;
  }
};

Source first_usable(const Exemplar& exemplar) {
  if (exemplar.mask.empty()) return {};
  const auto first = std::ranges::find_if(exemplar.mask.pixels, [](float m) { return m > 0.5f; });
  const auto index = static_cast<int>(first - exemplar.mask.pixels.begin());
  return {index % exemplar.mask.width, index / exemplar.mask.width};
}

/// A quilt of the whole target, or of what is to be made of it.
Quilt make_quilt(const Task& task, const Grid& grid, const QuiltRules& rules,
                 const QuiltGuide* guide, Random random, const QuiltReport& report) {
  std::optional<QuiltDirection> direction;
  if (task.directed()) direction.emplace(task.exemplar, task.guide, task.weight, grid.patch());
  const QuiltMaterial material{task.exemplar.image, direction ? &*direction : nullptr, guide,
                               task.quota, task.quota_factor};
  if (task.known.empty()) return lay_quilt(material, grid.x, grid.y, rules, random, report);
  Quilt quilt{task.known, SourceMap(task.size)};
  std::ranges::fill(quilt.source.pixels, first_usable(task.exemplar));
  std::vector<Ground> ground(task.mask.pixels.size());
  std::ranges::transform(task.mask.pixels, ground.begin(),
                         [](float m) { return m > 0.5f ? Ground::bare : Ground::firm; });
  fill_quilt(quilt, std::move(ground), material, grid.x, grid.y, rules, random, report);
  return quilt;
}

/// Pixels of what is made that lie within `reach` of known ones, as bare ground, the others of it
/// as laid.
std::vector<Ground> rim_of(const Task& task, int reach) {
  cv::Mat1b known(task.size.height, task.size.width), padded;
  for (int y = 0; y < known.rows; ++y)
    for (int x = 0; x < known.cols; ++x) known(y, x) = *task.mask.at(x, y) > 0.5f ? 0 : 1;
  const int across = tiles_x(task.tile) ? reach : 0, down = tiles_y(task.tile) ? reach : 0;
  cv::copyMakeBorder(known, padded, down, down, across, across, cv::BORDER_WRAP);
  const cv::Mat1b wide = [&] {
    cv::Mat1b result;
    cv::dilate(padded, result, cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8U));
    return result;
  }();
  std::vector<Ground> ground;
  ground.reserve(task.mask.pixels.size());
  for (int y = 0; y < known.rows; ++y)
    for (int x = 0; x < known.cols; ++x)
      ground.push_back(known(y, x) != 0                  ? Ground::firm
                       : wide(y + down, x + across) != 0 ? Ground::bare
                                                         : Ground::laid);
  return ground;
}

/// Known pixels cannot give way to a cut: along them smaller patches, which fit better, are laid
/// over the larger ones.
void mend_rim(Quilt& quilt, const Task& task, int patch, double overlap, const QuiltRules& rules,
              Random random, const QuiltReport& report) {
  for (int side = patch / 2; side >= smallest_rim_patch; side /= 2) {
    const auto axis = [&](int length, bool wraps) {
      return cover(length, side, static_cast<int>(overlap * side), wraps);
    };
    const Grid grid{axis(task.size.width, tiles_x(task.tile)),
                    axis(task.size.height, tiles_y(task.tile))};
    std::optional<QuiltDirection> direction;
    if (task.directed()) direction.emplace(task.exemplar, task.guide, task.weight, grid.patch());
    fill_quilt(quilt, rim_of(task, std::max(1, side / 8)),
               {task.exemplar.image, direction ? &*direction : nullptr, nullptr}, grid.x, grid.y,
               rules, random.stream(static_cast<std::uint64_t>(side)), report);
  }
}

/// The one with the least error among `attempts` quilts.
Image best_quilt(const Task& task, const Grid& grid, const QuiltRules& rules, Random random) {
  std::vector<Quilt> quilts(attempts);
  parallel_for(attempts, 1, [&](std::int64_t i, std::int64_t) {
    quilts[static_cast<std::size_t>(i)] =
        make_quilt(task, grid, rules, nullptr, random.stream(static_cast<std::uint64_t>(i)),
                   [](std::int64_t) {});
  });
  return std::move(std::ranges::min_element(quilts, {}, &Quilt::error)->canvas);
}

/// The best of several quilts at a quarter of the resolution; none where that is too small.
std::optional<QuiltGuide> make_guide(const QuiltingParams& params, const Task& task, int patch,
                                     const Grid& grid, Random random) {
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
  const Grid coarse = make_grid(params, patch, exemplar, quarter.size, quarter.tile);
  const QuiltRules rules{.tolerance = params.tolerance, .variety = params.variety};
  return QuiltGuide(quarter.exemplar.image, best_quilt(quarter.task(), coarse, rules, random),
                    grid.patch());
}

/// The size of which each exemplar has a piece that may be used.
Size usable_size(const std::vector<Exemplar>& exemplars) {
  if (exemplars.size() == 1 && exemplars.front().mask.empty())
    return exemplars.front().image.size();
  int side = std::numeric_limits<int>::max(), smallest = side;
  for (const Exemplar& exemplar : exemplars) {
    smallest = std::min({smallest, exemplar.image.width, exemplar.image.height});
    side = std::min({side, exemplar.image.width, exemplar.image.height,
                     exemplar.mask.empty() ? side : largest_usable_square(exemplar.mask)});
  }
  if (side < std::min(smallest, smallest_usable))
    throw Error("quilting needs usable pieces of {0}×{0} pixels: an exemplar's mask leaves {1}×{1}",
                smallest_usable, side);
  return {side, side};
}

Texture synthesise_whole(const QuiltingParams& params, const Request& request,
                         const Control& control) {
  const United united(request);
  const Target& target = request.target;
  const ExemplarQuota quota(request, united);
  const Task task{united.exemplar(), target.size,         target.tile,         target.known,
                  target.mask,       quota.guide(united), target.guide_weight, quota};
  const Size usable = usable_size(request.exemplars);
  const int patch = patch_side(params, usable, !task.guide.empty(), !task.known.empty());
  const Grid grid = make_grid(params, patch, usable, task.size, task.tile);
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
      request, windows, [&](const Request& part) { return synthesise_whole(params, part, {}); },
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
            .seconds = patches *
                       (pixels * (8 + 0.25 * overlap * channels) * (1 + guide / 4) + cuts) * 1e-9};
  // Two-dimensional transforms: spectra, and for each patch their products and a transform back.
  if (guided || request.known) {
    const double planes = (request.known ? channels + 1 : 0) + (guided ? 4 : 0);
    const double laid = patches * std::min(1.0, 2 * request.made);
    cost.bytes += 8 * planes * pixels + 16 * result;
    cost.seconds = (request.known ? 0 : cost.seconds) +
                   laid * (pixels * (20 + 4 * planes) + 40 * cuts) * (1 + guide / 4) * 1e-9;
  }
  return cost;
}

}  // namespace gramloom
