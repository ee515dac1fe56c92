#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "classic/pixel_algorithms.h"
#include "classic/pixel_matcher.h"
#include "classic/pixel_plane.h"
#include "classic/pixel_quilted_start.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// 1 for each pixel within `radius` of one that is 1; edges meet.
std::vector<std::uint8_t> widened(std::vector<std::uint8_t>& mask, Size size, int radius) {
  std::vector<std::uint8_t> result(mask.size());
  cv::Mat padded;
  cv::copyMakeBorder(cv::Mat(size.height, size.width, CV_8U, mask.data()), padded, radius, radius,
                     radius, radius, cv::BORDER_WRAP);
  cv::dilate(padded, padded, cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8U));
  cv::Mat out(size.height, size.width, CV_8U, result.data());
  padded(cv::Rect(radius, radius, size.width, size.height)).copyTo(out);
  return result;
}

/// Corrections of a canvas at one level.
class Correction {
 public:
  /// `random`: of the level.
  Correction(const Matcher& matcher, Canvas& canvas, Random random)
      : matcher_(matcher),
        canvas_(canvas),
        plane_(canvas, matcher.level, matcher.aim, matcher.params.radius),
        random_(random),
        changed_(canvas.source.size(), 1) {
    if (!matcher.aim.made.empty()) rim_ = rim(matcher.aim, canvas.tile, matcher.params.radius);
  }

  /// Gives known pixels about those to be made the sources that they are most like, of the same
  /// picture themselves: what is made continues these.
  void find_rim(bool same_picture) {
    const Level& level = matcher_.level;
    if (same_picture) {
      for (std::size_t i = 0; i < rim_.size(); ++i)
        if (rim_[i] != 0)
          canvas_.source[i] =
              level.nearest_usable({static_cast<int>(i) % canvas_.size.width * level.step,
                                    static_cast<int>(i) / canvas_.size.width * level.step});
      return;
    }
    parallel_for(
        static_cast<std::int64_t>(rim_.size()), 64, [&](std::int64_t begin, std::int64_t end) {
          for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            if (rim_[i] != 0)
              canvas_.source[i] = matcher_.nearest(plane_, static_cast<int>(i) % canvas_.size.width,
                                                   static_cast<int>(i) / canvas_.size.width);
        });
  }

  /// One correction of every pixel about which something changed during the pass before, in 4
  /// sub-passes of every second pixel in x and y. The pixels of a sub-pass see each other as they
  /// were before it, so their order does not matter.
  void pass(const std::function<void(double)>& report) {
    active_ = widened(changed_, canvas_.size, matcher_.params.radius);
    for (std::size_t i = 0; i < rim_.size(); ++i)
      if (rim_[i] == 0 && !matcher_.aim.is_made(i)) active_[i] = 0;
    random_ = random_.stream(active_.size());
    std::fill(changed_.begin(), changed_.end(), std::uint8_t{0});
    double done = 0;
    for (const Point first : {Point{0, 0}, Point{1, 1}, Point{0, 1}, Point{1, 0}}) {
      const int rows = (canvas_.size.height - first.y + 1) / 2;
      const int columns = (canvas_.size.width - first.x + 1) / 2;
      chosen_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
      const int band = matcher_.params.search == PixelSearch::exact ? 4 : 128;
      for (int row = 0; row < rows;
           row += band, done += 0.25 * std::min(1.0, static_cast<double>(band) / rows)) {
        report(done);
        parallel_for(std::min(band, rows - row), 2, [&](std::int64_t begin, std::int64_t end) {
          choose(first, columns, row + static_cast<int>(begin), row + static_cast<int>(end));
        });
      }
      parallel_for(rows, 32, [&](std::int64_t begin, std::int64_t end) {
        take(first, columns, static_cast<int>(begin), static_cast<int>(end));
      });
      plane_.set_border(canvas_);
    }
  }

 private:
  void choose(Point first, int columns, int begin, int end) {
    auto out = chosen_.begin() + static_cast<std::ptrdiff_t>(begin) * columns;
    for (int y = first.y + 2 * begin; y < first.y + 2 * end; y += 2)
      for (int x = first.x; x < canvas_.size.width; x += 2)
        *out++ = active_[canvas_.index(x, y)]
                     ? matcher_.best(canvas_, plane_, x, y, random_.stream(canvas_.index(x, y)))
                     : canvas_.at(x, y);
  }

  void take(Point first, int columns, int begin, int end) {
    auto from = chosen_.begin() + static_cast<std::ptrdiff_t>(begin) * columns;
    for (int y = first.y + 2 * begin; y < first.y + 2 * end; y += 2)
      for (int x = first.x; x < canvas_.size.width; x += 2, ++from) {
        if (canvas_.at(x, y) == *from) continue;
        canvas_.at(x, y) = *from;
        changed_[canvas_.index(x, y)] = 1;
        plane_.set(canvas_, x, y);
      }
  }

  const Matcher& matcher_;
  Canvas& canvas_;
  Plane plane_;
  Random random_;
  std::vector<std::uint8_t> changed_, active_;
  std::vector<std::uint8_t> rim_;  // known pixels that have sources too; empty: there are none
  std::vector<Point> chosen_;
};

void displace(Canvas& canvas, const Level& level, double jitter, Random random) {
  const auto reach = static_cast<float>(jitter * level.step);
  if (reach == 0) return;
  for (std::size_t i = 0; i < canvas.source.size(); ++i) {
    Random here = random.stream(i);
    const auto shift = [&] {
      return static_cast<int>(std::floor(here.uniform(-reach, reach) + 0.5f));
    };
    const int dx = shift(), dy = shift();
    canvas.source[i] = level.nearest_usable({canvas.source[i].x + dx, canvas.source[i].y + dy});
  }
}

}  // namespace

Canvas lefebvre_hoppe(const PixelParams& params, const Task& task, Random random,
                      const Control& control) {
  const int count = level_count(params.levels, task);
  auto levels = make_levels(task.exemplar.image, count);
  const std::vector<Aim> aims = direct(levels, task, params.radius);
  Canvas canvas = quilted_start(levels.back(), aims.back(), task.tile, params.variety, task.quota,
                                1 << std::max(0, count - 2), random.stream(0));
  // Progress counts pixels times passes; each level has 4 times the one before.
  const double all = static_cast<double>(params.passes) * (std::pow(4.0, count) - 1) / 3;
  double before = 0;
  for (int l = count - 1; l >= 0; --l) {
    const auto i = static_cast<std::size_t>(l);
    const Level& level = levels[i];
    if (l < count - 1) {
      canvas = refined(canvas, levels[i + 1], level, aims[i].size);
      displace(canvas, level, params.jitter, random.stream(2 * i + 1));
    }
    const Matcher matcher(level, aims[i], params, random.stream(2 * i + 2));
    Correction correction(matcher, canvas, random.stream(2 * i + 2).stream(3));
    if (l == count - 1) correction.find_rim(task.same_picture);
    const double pixels = std::pow(4.0, count - 1 - l);
    for (int pass = 0; pass < params.passes; ++pass, before += pixels)
      correction.pass([&](double done) {
        control.step(std::llround(1000 * (before + done * pixels) / all), 1000);
      });
  }
  control.step(1000, 1000);
  return canvas;
}

}  // namespace gramloom::pixel
