#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "classic/quilt_task.h"

namespace gramloom {

namespace {

/// Smaller ones would hold nothing of a texture.
constexpr int smallest_rim_patch = 12;

/// Pixels of what is made that lie within `reach` of known ones, as bare ground, the others of it
/// as laid.
std::vector<Ground> rim_of(const QuiltTask& task, int reach) {
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

}  // namespace

void mend_rim(Quilt& quilt, const QuiltTask& task, int patch, double overlap,
              const QuiltRules& rules, Random random, const QuiltReport& report) {
  for (int side = patch / 2; side >= smallest_rim_patch; side /= 2) {
    const auto axis = [&](int length, bool wraps) {
      return cover(length, side, static_cast<int>(overlap * side), wraps);
    };
    const QuiltGrid grid{axis(task.size.width, tiles_x(task.tile)),
                         axis(task.size.height, tiles_y(task.tile))};
    std::optional<QuiltDirection> direction;
    if (task.directed()) direction.emplace(task.exemplar, task.guide, task.weight, grid.patch());
    fill_quilt(quilt, rim_of(task, std::max(1, side / 8)),
               {task.exemplar.image, direction ? &*direction : nullptr, nullptr}, grid.x, grid.y,
               rules, random.stream(static_cast<std::uint64_t>(side)), report);
  }
}

}  // namespace gramloom
