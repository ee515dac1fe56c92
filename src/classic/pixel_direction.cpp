#include "classic/pixel_direction.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "classic/pixel_match.h"
#include "core/threads.h"
#include "signal/squared_distance.h"
#include "signal/united.h"

namespace gramloom::pixel {
namespace {

constexpr double near_known = 16;     // pixels
constexpr double most_samples = 3e5;  // of an exemplar that is searched in full

/// The guide's channels, then their means over squares of this reach; of the last `shares` again
/// themselves.
Image with_means(const Image& guide, int reach, int shares) {
  Image result(guide.size(), 2 * guide.channels);
  parallel_for(guide.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      cv::Mat1f plane(guide.height, guide.width), means;
      for (int y = 0; y < guide.height; ++y)
        for (int x = 0; x < guide.width; ++x) plane(y, x) = guide.at(x, y)[c];
      if (c >= guide.channels - shares)
        means = plane;
      else
        cv::blur(plane, means, {2 * reach + 1, 2 * reach + 1}, {-1, -1}, cv::BORDER_REPLICATE);
      for (int y = 0; y < guide.height; ++y)
        for (int x = 0; x < guide.width; ++x) {
          result.at(x, y)[c] = plane(y, x);
          result.at(x, y)[guide.channels + c] = means(y, x);
        }
    }
  });
  return result;
}

/// For each pixel the index of the nearest one that is usable, of which there is one.
std::vector<int> nearest_usable(const std::vector<std::uint8_t>& usable, Size size) {
  cv::Mat1b unusable(size.height, size.width);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      unusable(y, x) = usable[static_cast<std::size_t>(y * size.width + x)] != 0 ? 0 : 1;
  cv::Mat1f distance;
  cv::Mat1i label;
  cv::distanceTransform(unusable, distance, label, cv::DIST_L2, cv::DIST_MASK_5,
                        cv::DIST_LABEL_PIXEL);
  std::vector<int> index_of(1);  // labels begin with 1
  for (int i = 0; i < size.width * size.height; ++i)
    if (usable[static_cast<std::size_t>(i)] != 0) {
      const auto l = static_cast<std::size_t>(label(i / size.width, i % size.width));
      if (index_of.size() <= l) index_of.resize(l + 1);
      index_of[l] = i;
    }
  std::vector<int> nearest;
  nearest.reserve(usable.size());
  for (const int l : label) nearest.push_back(index_of[static_cast<std::size_t>(l)]);
  return nearest;
}

/// Samples of a coarser level whose children may all be used; where that leaves none, any child.
std::vector<std::uint8_t> coarser_usable(const std::vector<std::uint8_t>& finer, const Level& from,
                                         const Level& to) {
  const auto count_children = [&](int index) {
    const Point p = to.point(index);
    int count = 0;
    for (const Point d : {Point{0, 0}, Point{1, 0}, Point{0, 1}, Point{1, 1}})
      count += finer[static_cast<std::size_t>(from.index(
          from.nearest({p.x * to.ratio + d.x * from.step, p.y * to.ratio + d.y * from.step})))];
    return count;
  };
  for (const int least : {4, 1}) {
    std::vector<std::uint8_t> usable;
    for (int i = 0; i < to.count(); ++i) usable.push_back(count_children(i) >= least ? 1 : 0);
    if (std::ranges::find(usable, 1) != usable.end()) return usable;
  }
  // Between the coarse samples: the one that is about there.
  std::vector<std::uint8_t> usable(static_cast<std::size_t>(to.count()), 0);
  const auto first = static_cast<int>(std::ranges::find(finer, 1) - finer.begin());
  const Point p = from.point(first);
  usable[static_cast<std::size_t>(to.index(to.nearest({p.x / to.ratio, p.y / to.ratio})))] = 1;
  return usable;
}

/// The next level's guide: blurred but in the last `shares` channels.
Image blurred_guide(const Image& guide, int shares) {
  Image result = blurred(guide);
  const auto first = static_cast<std::size_t>(guide.channels - shares);
  const auto channels = static_cast<std::size_t>(guide.channels);
  for (std::size_t i = 0; i < result.pixels.size(); i += channels)
    for (std::size_t c = first; c < channels; ++c) result.pixels[i + c] = guide.pixels[i + c];
  return result;
}

void direct_exemplar(std::vector<Level>& levels, const Exemplar& exemplar, int radius, int shares) {
  if (!exemplar.mask.empty()) {
    std::vector<std::uint8_t> usable;
    for (const float m : exemplar.mask.pixels) usable.push_back(m > 0.5f ? 1 : 0);
    for (std::size_t l = 0; l < levels.size(); ++l) {
      if (l > 0) usable = coarser_usable(usable, levels[l - 1], levels[l]);
      levels[l].usable = nearest_usable(usable, levels[l].colours.size());
    }
  }
  if (exemplar.guide.empty()) return;
  Image guide = exemplar.guide;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    if (l > 0) guide = blurred_guide(levels[l].ratio == 2 ? halved_samples(guide) : guide, shares);
    levels[l].guide = with_means(guide, radius * levels[l].step, shares);
  }
}

/// Colours where they are known, blurred without those that are not, and halved; likewise `made`.
void halve_known(Image& colours, std::vector<std::uint8_t>& made) {
  const auto channels = static_cast<std::size_t>(colours.channels);
  Image weights(colours.size(), 1), weighted = colours;
  for (std::size_t i = 0; i < made.size(); ++i) {
    weights.pixels[i] = made[i] != 0 ? 0.0f : 1.0f;
    for (std::size_t c = 0; c < channels; ++c)
      weighted.pixels[i * channels + c] *= weights.pixels[i];
  }
  weights = halved_samples(blurred(weights));
  weighted = halved_samples(blurred(weighted));
  std::vector<std::uint8_t> coarse;
  for (int y = 0; y < weights.height; ++y)
    for (int x = 0; x < weights.width; ++x) {
      const int right = std::min(2 * x + 1, colours.width - 1);
      const int below = std::min(2 * y + 1, colours.height - 1);
      std::uint8_t any = 0;
      for (const int v : {2 * y, below})
        for (const int u : {2 * x, right})
          any |= made[static_cast<std::size_t>(v) * static_cast<std::size_t>(colours.width) +
                      static_cast<std::size_t>(u)];
      coarse.push_back(any);
      const float weight = *weights.at(x, y);
      for (std::size_t c = 0; c < channels; ++c)
        weighted.at(x, y)[c] = weight > 0 ? weighted.at(x, y)[c] / weight : 0;
    }
  colours = std::move(weighted);
  made = std::move(coarse);
}

}  // namespace

float Aim::guide_error(const Level& level, int sample, int x, int y) const {
  const auto channels = static_cast<std::size_t>(guide.channels), own = channels / 2;
  const float *wanted = guide.at(x, y),
              *there = level.guide.pixels.data() + static_cast<std::size_t>(sample) * channels;
  const float squared_weight = *map_at(weight, x, y);
  return 0.5f * (squared_weight * gramloom::squared_distance(wanted, there, own) +
                 std::min(squared_weight, 1.0f) *
                     gramloom::squared_distance(wanted + own, there + own, own));
}

int level_count(int asked, const Task& task) {
  const Size exemplar = task.exemplar.image.size();
  const int most = level_count(asked, exemplar, task.size);
  if (asked > 0 || task.mask.empty()) return most;
  cv::Mat1b made(task.size.height, task.size.width);
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x) made(y, x) = *task.mask.at(x, y) > 0.5f ? 1 : 0;
  cv::Mat1f distance;
  cv::distanceTransform(made, distance, cv::DIST_L2, cv::DIST_MASK_3);
  double depth = 0;
  cv::minMaxLoc(distance, nullptr, &depth);
  double samples = 1.0 * exemplar.width * exemplar.height;
  int levels = 1;
  for (; levels < most && (depth > near_known || samples > most_samples); ++levels) {
    depth /= 2;
    if (levels > 1) samples /= 4;
  }
  return levels;
}

std::vector<Aim> direct(std::vector<Level>& levels, const Task& task, int radius) {
  direct_exemplar(levels, task.exemplar, radius, task.shares);
  std::vector<Aim> aims(levels.size());
  Image guide = task.guide, weight = task.guide_weight;
  if (weight.empty()) weight = Image(1, 1, 1, 1.0f);
  for (float& w : weight.pixels) w *= w;
  Image colours;
  std::vector<std::uint8_t> made;
  if (!task.known.empty()) {
    colours = comparison_colours(task.known, colour_pca(task.exemplar.image));
    for (const float m : task.mask.pixels) made.push_back(m > 0.5f ? 1 : 0);
  }
  for (std::size_t l = 0; l < levels.size(); ++l) {
    if (l > 0 && !guide.empty()) {
      guide = halved_samples(blurred(guide));
      if (weight.size() != Size{1, 1}) weight = halved_samples(blurred(weight));
    }
    if (l > 0 && !made.empty()) halve_known(colours, made);
    aims[l] = {colours, made, guide.empty() ? Image{} : with_means(guide, radius, task.shares),
               weight, size_at(task.size, static_cast<int>(l))};
  }
  return aims;
}

void add_direction(const Level& level, const Aim& aim, int x, int y, float weight,
                   std::vector<float>& errors) {
  if (!aim.guide.empty() && aim.is_made(aim.index(x, y)))
    for (std::size_t i = 0; i < errors.size(); ++i)
      errors[i] += weight * aim.guide_error(level, static_cast<int>(i), x, y);
  for (std::size_t i = 0; i < level.usable.size(); ++i)
    if (!level.may_use(static_cast<int>(i))) errors[i] = out_of_reach;
}

std::vector<std::uint8_t> rim(const Aim& aim, Tile tile, int radius) {
  cv::Mat1b made(aim.size.height, aim.size.width), wide;
  std::copy(aim.made.begin(), aim.made.end(), made.begin());
  const int across = tiles_x(tile) ? radius : 0, down = tiles_y(tile) ? radius : 0;
  cv::copyMakeBorder(made, wide, down, down, across, across, cv::BORDER_WRAP);
  cv::dilate(wide, wide, cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8U));
  std::vector<std::uint8_t> result;
  result.reserve(aim.made.size());
  for (int y = 0; y < made.rows; ++y)
    for (int x = 0; x < made.cols; ++x)
      result.push_back(wide(y + down, x + across) != 0 && made(y, x) == 0 ? 1 : 0);
  return result;
}

}  // namespace gramloom::pixel
