#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "classic/pixel_algorithms.h"
#include "classic/pixel_features.h"
#include "classic/pixel_match.h"
#include "classic/pixel_plane.h"
#include "classic/pixel_quilted_start.h"
#include "core/threads.h"

namespace gramloom::pixel {
namespace {

/// What finds the best source for a pixel at one level.
struct Matcher {
  const Level& level;
  const PixelParams& params;
  Projection projection;
  std::vector<Feature> features;
  std::vector<Point> similar;  // [sample][candidates]
  Reference reference;         // for the exact search
  std::vector<float> weights;

  Matcher(const Level& level_, const PixelParams& params_, Random random)
      : level(level_),
        params(params_),
        projection(make_projection(level, params.radius, random.stream(0))),
        features(make_features(level, projection)),
        similar(similar_samples(level, features, params.candidates, distance_apart(level),
                                random.stream(1))),
        reference(level, params.search == PixelSearch::exact ? params.radius : 0),
        weights(gaussian_weights(params.radius)) {}

  Point best(const Canvas& canvas, const Plane& plane, int x, int y) const {
    return params.search == PixelSearch::exact ? best_of_all(plane, x, y)
                                               : best_of_coherent(canvas, plane, x, y);
  }

 private:
  Point best_of_coherent(const Canvas& canvas, const Plane& plane, int x, int y) const;
  Point best_of_all(const Plane& plane, int x, int y) const;
};

Point Matcher::best_of_coherent(const Canvas& canvas, const Plane& plane, int x, int y) const {
  const Feature wanted = plane.feature(projection, x, y);
  const auto candidates = static_cast<std::size_t>(params.candidates);
  std::array<Point, 9 * 16> tried;
  auto end = tried.begin();
  Point best = canvas.at(x, y);
  float least = INFINITY;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      int near_x = x + dx, near_y = y + dy;
      if (!canvas.wrap(near_x, near_y)) continue;
      const auto source = static_cast<std::size_t>(level.index(canvas.at(near_x, near_y)));
      for (std::size_t i = source * candidates; i < (source + 1) * candidates; ++i) {
        const Point p{similar[i].x - dx * level.step, similar[i].y - dy * level.step};
        if (!level.contains(p) || std::find(tried.begin(), end, p) != end) continue;
        *end++ = p;
        const float distance =
            squared_distance(wanted, features[static_cast<std::size_t>(level.index(p))]);
        if (distance < least) {
          least = distance;
          best = p;
        }
      }
    }
  return best;
}

Point Matcher::best_of_all(const Plane& plane, int x, int y) const {
  std::vector<Known> neighbourhood;
  auto weight = weights.begin();
  for (int dy = -params.radius; dy <= params.radius; ++dy)
    for (int dx = -params.radius; dx <= params.radius; ++dx)
      neighbourhood.push_back({reference.offset(dx, dy), *weight++, plane.at(x + dx, y + dy)});
  const auto errors = reference.errors(neighbourhood);
  return level.point(
      static_cast<int>(std::min_element(errors.begin(), errors.end()) - errors.begin()));
}

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
  Correction(const Matcher& matcher, Canvas& canvas)
      : matcher_(matcher),
        canvas_(canvas),
        plane_(canvas, matcher.level, matcher.params.radius),
        changed_(canvas.source.size(), 1) {}

  /// One correction of every pixel about which something changed during the pass before, in 4
  /// sub-passes of every second pixel in x and y. The pixels of a sub-pass see each other as they
  /// were before it, so their order does not matter.
  void pass(const std::function<void(double)>& report) {
    active_ = widened(changed_, canvas_.size, matcher_.params.radius);
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
        *out++ =
            active_[canvas_.index(x, y)] ? matcher_.best(canvas_, plane_, x, y) : canvas_.at(x, y);
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
  std::vector<std::uint8_t> changed_, active_;
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
    canvas.source[i] = level.nearest({canvas.source[i].x + dx, canvas.source[i].y + dy});
  }
}

}  // namespace

Canvas lefebvre_hoppe(const PixelParams& params, const Image& exemplar, const Target& target,
                      Random random, const Control& control) {
  const int count = level_count(params.levels, exemplar.size(), target.size);
  const auto levels = make_levels(exemplar, count);
  Canvas canvas = quilted_start(levels.back(), size_at(target.size, count - 1), target.tile,
                                params.variety, random.stream(0));
  // Progress counts pixels times passes; each level has 4 times the one before.
  const double all = static_cast<double>(params.passes) * (std::pow(4.0, count) - 1) / 3;
  double before = 0;
  for (int l = count - 1; l >= 0; --l) {
    const auto i = static_cast<std::size_t>(l);
    const Level& level = levels[i];
    if (l < count - 1) {
      canvas = refined(canvas, levels[i + 1], level, size_at(target.size, l));
      displace(canvas, level, params.jitter, random.stream(2 * i + 1));
    }
    const Matcher matcher(level, params, random.stream(2 * i + 2));
    Correction correction(matcher, canvas);
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
