#include "signal/turned.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/error.h"
#include "signal/channel_groups.h"
#include "signal/resize.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// How much the guide of turns counts: neighbouring steps of 15° then differ by half of a picture's
/// variance, so that a copy is used where it belongs and a little beyond.
constexpr float guide_weight = 3;
constexpr double longest_row = 60'000;  // that sources can name
constexpr int turn_channels = 3;        // of the guide: cosine, sine, logarithm of the scale

/// Turns and scales in steps, as whole numbers of these.
struct Steps {
  double turn = 1.0 / 24;
  double scale = 0.25;
};
using Step = std::pair<int, int>;

Step step_at(const Image& turn, int x, int y, const Steps& steps) {
  const float* value = map_at(turn, x, y);
  const int around = std::max(1, static_cast<int>(std::lround(1 / steps.turn)));
  const int angle = static_cast<int>(std::lround(double{value[0]} / steps.turn)) % around;
  return {(angle + around) % around, static_cast<int>(std::lround(double{value[1]} / steps.scale))};
}

std::set<Step> steps_of(const Target& target, const Steps& steps) {
  std::set<Step> all;
  for (int y = 0; y < target.turn.height; ++y)
    for (int x = 0; x < target.turn.width; ++x) all.insert(step_at(target.turn, x, y, steps));
  return all;
}

/// Pixels of a copy's bounding box.
Size size_of_copy(Size size, double turn, double scale) {
  const double angle = 2 * std::numbers::pi * turn;
  const double c = std::abs(std::cos(angle)) * scale;
  const double s = std::abs(std::sin(angle)) * scale;
  const auto side = [](double length) {
    return std::max(1, static_cast<int>(std::lround(length)));
  };
  return {side(size.width * c + size.height * s), side(size.width * s + size.height * c)};
}

double pixels_of_copies(const std::vector<Exemplar>& exemplars, const std::set<Step>& all,
                        const Steps& steps) {
  double width = 0;  // side by side, as methods lay them
  double height = 0;
  for (const Exemplar& exemplar : exemplars)
    for (const auto& [turn, scale] : all) {
      const Size size =
          size_of_copy(exemplar.image.size(), turn * steps.turn, std::exp2(scale * steps.scale));
      width += size.width + 1;
      height = std::max(height, 1.0 * size.height);
    }
  return width > longest_row ? std::numeric_limits<double>::infinity() : width * height;
}

/// As fine as the copies' pixels allow.
Steps steps_for(const Request& request) {
  Steps steps;
  while (pixels_of_copies(request.exemplars, steps_of(request.target, steps), steps) >
         Turned::most_pixels) {
    if (steps.turn >= 0.25)
      throw Error("an exemplar that is to be turned has {}×{} pixels: make it smaller (max_side)",
                  request.exemplars.front().image.width, request.exemplars.front().image.height);
    steps.turn *= 2;
    steps.scale *= 2;
  }
  return steps;
}

Image warped(const Image& image, Size size, const cv::Matx23d& back, int interpolation) {
  return filtered_in_groups(image, size, [&](const cv::Mat& from, cv::Mat& to) {
    cv::warpAffine(from, to, back, {size.width, size.height}, interpolation | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
  });
}

/// What is made smaller is averaged first, or fine things would flicker.
Image turned_image(const Image& image, Size size, const cv::Matx23d& back, double scale) {
  if (scale >= 1) return warped(image, size, back, cv::INTER_CUBIC);
  const Size small{std::max(1, static_cast<int>(std::lround(image.width * scale))),
                   std::max(1, static_cast<int>(std::lround(image.height * scale)))};
  const double x = 1.0 * small.width / image.width;
  const double y = 1.0 * small.height / image.height;
  const cv::Matx23d to_small(x * back(0, 0), x * back(0, 1), x * back(0, 2) + (x - 1) / 2,
                             y * back(1, 0), y * back(1, 1), y * back(1, 2) + (y - 1) / 2);
  return warped(resize(image, small), size, to_small, cv::INTER_CUBIC);
}

/// Directions turn with their picture; counter-clockwise is from x towards y up, and where green
/// points down, y is turned over.
void turn_normals(Image& image, const Layer& layer, double turn) {
  const double angle = 2 * std::numbers::pi * turn * (layer.green == GreenAxis::up ? 1 : -1);
  const auto c = static_cast<float>(std::cos(angle));
  const auto s = static_cast<float>(std::sin(angle));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float* normal = image.at(x, y) + layer.first;
      const float nx = 2 * normal[0] - 1;
      const float ny = 2 * normal[1] - 1;
      normal[0] = (1 + c * nx - s * ny) / 2;
      normal[1] = (1 + s * nx + c * ny) / 2;
    }
}

/// 1 where the copy's pixel lies well within usable pixels.
Image mask_of_copy(const Exemplar& exemplar, Size size, const cv::Matx23d& back) {
  const Size of = exemplar.image.size();
  Image mask(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double u = back(0, 0) * x + back(0, 1) * y + back(0, 2);
      const double v = back(1, 0) * x + back(1, 1) * y + back(1, 2);
      const int left = static_cast<int>(std::floor(u + 1e-6));
      const int top = static_cast<int>(std::floor(v + 1e-6));
      const int right = static_cast<int>(std::ceil(u - 1e-6));
      const int below = static_cast<int>(std::ceil(v - 1e-6));
      if (left < 0 || top < 0 || right >= of.width || below >= of.height) continue;
      const auto usable = [&](int px, int py) {
        return exemplar.mask.empty() || *exemplar.mask.at(px, py) > 0.5f;
      };
      if (usable(left, top) && usable(right, top) && usable(left, below) && usable(right, below))
        *mask.at(x, y) = 1;
    }
  return mask;
}

float relative_weight(const Target& target) {
  if (target.guide.empty() || target.guide_weight.empty()) return guide_weight;
  const float most = std::ranges::max(target.guide_weight.pixels);
  return most > 0 ? guide_weight / most : guide_weight;
}

void set_turn_guide(float* guide, double turn, double scale, float weight) {
  const double angle = 2 * std::numbers::pi * turn;
  guide[0] = weight * static_cast<float>(std::cos(angle));
  guide[1] = weight * static_cast<float>(std::sin(angle));
  guide[2] = weight * static_cast<float>(scale);
}

/// `guide`, which may be empty, with the turn's channels behind it.
Image with_turn(const Image& guide, Size size) {
  Image result(size, guide.channels + turn_channels);
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x)
      std::copy_n(guide.at(x, y), guide.channels, result.at(x, y));
  return result;
}

}  // namespace

Turned::Turned(const Request& request) {
  const Steps steps = steps_for(request);
  const std::set<Step> all = steps_of(request.target, steps);
  const float weight = relative_weight(request.target);
  request_.random = request.random;
  request_.target = request.target;
  Target& target = request_.target;
  target.turn = {};
  target.guide = with_turn(request.target.guide, target.size);
  for (int y = 0; y < target.size.height; ++y)
    for (int x = 0; x < target.size.width; ++x) {
      const float* turn = map_at(request.target.turn, x, y);
      set_turn_guide(target.guide.at(x, y) + request.target.guide.channels, double{turn[0]},
                     double{turn[1]}, weight);
    }
  for (const Exemplar& exemplar : request.exemplars) sizes_.push_back(exemplar.image.size());
  std::vector<std::size_t> number;  // of each copy's exemplar
  for (const auto& [turn, scale] : all)
    for (std::size_t i = 0; i < request.exemplars.size(); ++i) {
      copies_.push_back(add_copy(request.exemplars[i], i, turn * steps.turn, scale * steps.scale));
      Exemplar& copy = request_.exemplars.back();
      copy.guide = with_turn(copy.guide, copy.image.size());
      const int own = copy.guide.channels - turn_channels;
      for (int y = 0; y < copy.guide.height; ++y)
        for (int x = 0; x < copy.guide.width; ++x)
          set_turn_guide(copy.guide.at(x, y) + own, turn * steps.turn, scale * steps.scale, weight);
    }
  if (target.weights.empty()) return;
  // Each copy has the weight of its exemplar.
  Image weights(target.weights.size(), static_cast<int>(copies_.size()));
  for (int y = 0; y < weights.height; ++y)
    for (int x = 0; x < weights.width; ++x)
      for (std::size_t i = 0; i < copies_.size(); ++i)
        weights.at(x, y)[i] = request.target.weights.at(x, y)[copies_[i].exemplar];
  target.weights = std::move(weights);
}

Turned::Copy Turned::add_copy(const Exemplar& exemplar, std::size_t number, double turn,
                              double log_scale) {
  const Size of = exemplar.image.size();
  const double scale = std::exp2(log_scale);
  const Size size = size_of_copy(of, turn, scale);
  const double angle = 2 * std::numbers::pi * turn;
  const double c = std::cos(angle) / scale;
  const double s = std::sin(angle) / scale;
  // Rows go down: turned counter-clockwise, the copy's x is the exemplar's x seen from −angle.
  const double cx = (size.width - 1) / 2.0, cy = (size.height - 1) / 2.0;
  const double ox = (of.width - 1) / 2.0, oy = (of.height - 1) / 2.0;
  const cv::Matx23d back(c, -s, ox - c * cx + s * cy, s, c, oy - s * cx - c * cy);
  Exemplar copy;
  copy.layers = exemplar.layers;
  // Filters reach over masked pixels: these hold what is beside them.
  copy.image =
      turned_image(exemplar.mask.empty() ? exemplar.image : extended(exemplar.image, exemplar.mask),
                   size, back, scale);
  clamp_to(copy.image, channel_range(exemplar.image));
  for (const Layer& layer : copy.layers)
    if (layer.kind == MapKind::normal) turn_normals(copy.image, layer, turn);
  if (!exemplar.guide.empty()) copy.guide = warped(exemplar.guide, size, back, cv::INTER_NEAREST);
  copy.mask = mask_of_copy(exemplar, size, back);
  request_.exemplars.push_back(std::move(copy));
  return {number, {back(0, 0), back(0, 1), back(0, 2), back(1, 0), back(1, 1), back(1, 2)}};
}

void Turned::name_sources(SourceMap& sources) const {
  for (Source& pixel : sources.pixels) {
    const Copy& copy = copies_[pixel.exemplar];
    const Size size = sizes_[copy.exemplar];
    const double x = static_cast<double>(pixel.x);
    const double y = static_cast<double>(pixel.y);
    const double* b = copy.back;
    pixel = {
        std::clamp(static_cast<int>(std::lround(b[0] * x + b[1] * y + b[2])), 0, size.width - 1),
        std::clamp(static_cast<int>(std::lround(b[3] * x + b[4] * y + b[5])), 0, size.height - 1),
        static_cast<int>(copy.exemplar)};
  }
}

RequestSize size_of_turned(const RequestSize& request) {
  RequestSize turned = request;
  turned.turn = false;
  turned.guide = true;
  double area = 0;
  for (const ExemplarSize& exemplar : request.exemplars)
    area += 1.0 * exemplar.size.width * exemplar.size.height;
  // Full circles of copies with their corners, some of them enlarged.
  const int side = static_cast<int>(std::sqrt(std::min(Turned::most_pixels, 24 * 2 * 4 * area)));
  ExemplarSize all = request.exemplars.front();
  all.size = {side, side};
  all.mask = all.guide = true;
  turned.exemplars = {all};
  return turned;
}

}  // namespace gramloom
