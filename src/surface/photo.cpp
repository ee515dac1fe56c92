#include "surface/photo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/threads.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

constexpr float darkest = 1.0f / 1024;  // below, a logarithm would tell of noise

int shorter_side(const cv::Mat& plane) { return std::min(plane.cols, plane.rows); }

// A wide Gaussian is as good, and much faster, on a picture that was shrunk first.
cv::Mat blurred(const cv::Mat& plane, double deviation) {
  const int shrink = std::max(1, static_cast<int>(deviation / 4));
  const cv::Size size{std::max(1, plane.cols / shrink), std::max(1, plane.rows / shrink)};
  cv::Mat small, result;
  if (shrink > 1) cv::resize(plane, small, size, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(shrink > 1 ? small : plane, result, {}, deviation / shrink, deviation / shrink,
                   cv::BORDER_REFLECT);
  if (shrink > 1) cv::resize(result.clone(), result, plane.size(), 0, 0, cv::INTER_CUBIC);
  return result;
}

// The powers of the place, −1 to 1 along each side, of a quadratic polynomial.
std::array<double, 6> powers(double x, double y) { return {1, x, y, x * x, x * y, y * y}; }

// The quadratic polynomial that comes closest to a plane, fitted to a small copy of it.
cv::Mat quadratic_fit(const cv::Mat& plane) {
  cv::Mat small;
  cv::resize(plane, small, {std::min(plane.cols, 64), std::min(plane.rows, 64)}, 0, 0,
             cv::INTER_AREA);
  cv::Mat products = cv::Mat::zeros(6, 6, CV_64F), sums = cv::Mat::zeros(6, 1, CV_64F);
  for (int y = 0; y < small.rows; ++y)
    for (int x = 0; x < small.cols; ++x) {
      // Middles of the small pixels, as places of the large picture.
      const double u = (2.0 * x + 1) / small.cols - 1, v = (2.0 * y + 1) / small.rows - 1;
      const auto p = powers(u, v);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j)
          products.at<double>(i, j) +=
              p[static_cast<std::size_t>(i)] * p[static_cast<std::size_t>(j)];
        sums.at<double>(i) += p[static_cast<std::size_t>(i)] * double{small.at<float>(y, x)};
      }
    }
  cv::Mat weights;
  cv::solve(products, sums, weights, cv::DECOMP_SVD);  // of a row of pixels, too
  cv::Mat fit(plane.size(), CV_32F);
  for (int y = 0; y < fit.rows; ++y)
    for (int x = 0; x < fit.cols; ++x) {
      const auto p = powers((2.0 * x + 1) / fit.cols - 1, (2.0 * y + 1) / fit.rows - 1);
      double value = 0;
      for (int i = 0; i < 6; ++i) value += weights.at<double>(i) * p[static_cast<std::size_t>(i)];
      fit.at<float>(y, x) = static_cast<float>(value);
    }
  return fit;
}

// What varies over the whole of a plane of logarithms.
cv::Mat slow_part(const cv::Mat& logarithms, double scale) {
  const cv::Mat fit = quadratic_fit(logarithms);
  return fit + blurred(logarithms - fit, scale * shorter_side(logarithms));
}

cv::Mat logarithm_of(const cv::Mat& plane) {
  cv::Mat result;
  cv::log(cv::max(plane, darkest), result);
  return result;
}

int colours_of(const Image& image) { return image.channels >= 3 ? 3 : 1; }

// ITU-R BT.709's weights, on values as encoded.
cv::Mat luminance_of(const Image& image) {
  if (colours_of(image) == 1) return channel_plane(image, 0);
  return 0.2126 * channel_plane(image, 0) + 0.7152 * channel_plane(image, 1) +
         0.0722 * channel_plane(image, 2);
}

Image image_of(const cv::Mat& plane) {
  Image image(plane.cols, plane.rows, 1);
  set_channel(image, 0, plane);
  return image;
}

// The value below which a share of all values lies.
float quantile_of(const cv::Mat& plane, double share) {
  std::vector<float> values(plane.begin<float>(), plane.end<float>());
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void check_convex(const std::vector<cv::Point2f>& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Point2f a = corners[(i + 1) % 4] - corners[i],
                      b = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(a.x * b.y - a.y * b.x > 0))
      throw ConfigError(
          "corners: allowed are four corners of a convex quadrangle, clockwise from the top left");
  }
}

// They may lie on the picture's edges, but not beyond.
void check_inside(const std::vector<cv::Point2f>& corners, const Image& photo) {
  for (const cv::Point2f& corner : corners)
    if (!(corner.x >= 0 && corner.y >= 0 && corner.x <= static_cast<float>(photo.width) &&
          corner.y <= static_cast<float>(photo.height)))
      throw ConfigError("corners: {:g},{:g} is outside the picture of {}×{} pixels", corner.x,
                        corner.y, photo.width, photo.height);
}

}  // namespace

Image set_right(const Image& photo, const std::vector<double>& corners,
                const std::vector<int>& size) {
  if (corners.size() != 8)
    throw ConfigError("corners has {} numbers, allowed are 8: x and y of four corners",
                      corners.size());
  if (!size.empty() && size.size() != 2)
    throw ConfigError("photo_size has {} numbers, allowed are width and height", size.size());
  std::vector<cv::Point2f> from;
  for (std::size_t i = 0; i < 8; i += 2)
    from.emplace_back(static_cast<float>(corners[i]), static_cast<float>(corners[i + 1]));
  check_inside(from, photo);
  check_convex(from);
  const auto side = [&](std::size_t a, std::size_t b) { return cv::norm(from[a] - from[b]); };
  const auto rounded = [](double length) {
    return std::max(2, static_cast<int>(std::lround(length)));
  };
  const Size to = size.empty() ? Size{rounded((side(0, 1) + side(3, 2)) / 2 + 1),
                                      rounded((side(0, 3) + side(1, 2)) / 2 + 1)}
                               : Size{size[0], size[1]};
  const auto right = static_cast<float>(to.width - 1), bottom = static_cast<float>(to.height - 1);
  const cv::Mat homography = cv::getPerspectiveTransform(
      from, std::vector<cv::Point2f>{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}});
  Image result(to, photo.channels);
  for (int c = 0; c < photo.channels; ++c) {
    cv::Mat plane;
    cv::warpPerspective(channel_plane(photo, c), plane, homography, {to.width, to.height},
                        cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    set_channel(result, c, plane);
  }
  clamp_to(result, channel_range(photo));  // cubics overshoot
  return result;
}

Image without_shading(const Image& photo, double scale, double amount, ColourCast cast) {
  const int colours = colours_of(photo);
  const cv::Mat common = slow_part(logarithm_of(luminance_of(photo)), scale);
  const double level = cv::mean(common)[0];
  Image result = photo;
  for (int c = 0; c < colours; ++c) {
    const cv::Mat plane = channel_plane(photo, c);
    cv::Mat light = common;
    double own_level = level;
    if (cast != ColourCast::keep && colours > 1) {
      light = slow_part(logarithm_of(plane), scale);
      own_level = cv::mean(light)[0];
    }
    cv::Mat factor;
    cv::exp((own_level - light) * amount, factor);
    if (cast == ColourCast::grey) factor *= std::exp(level - own_level);
    set_channel(result, c, plane.mul(factor));
  }
  return result;
}

Image height_guess(const Image& colour, double scale, double detail, bool bright_is_deep,
                   Tile wraps) {
  const double coarsest = std::max(1.0, scale * std::min(colour.width, colour.height) / 2);
  // Beyond edges that meet the picture goes on, as far as the widest blur looks.
  const auto reach = static_cast<int>(std::ceil(3 * coarsest));
  const int across = tiles_x(wraps) ? reach : 0, down = tiles_y(wraps) ? reach : 0;
  cv::Mat brightness;
  cv::copyMakeBorder(luminance_of(colour), brightness, down, down, across, across, cv::BORDER_WRAP);
  const int octaves = 1 + static_cast<int>(std::floor(std::log2(coarsest)));
  cv::Mat height = cv::Mat::zeros(brightness.size(), CV_32F);
  cv::Mat coarse = blurred(brightness, coarsest);
  double weight = 1;
  for (int octave = 0; octave <= octaves; ++octave) {
    const double deviation = coarsest * std::exp2(-octave - 1);
    const cv::Mat fine = octave == octaves ? brightness : blurred(brightness, deviation);
    height += weight * (fine - coarse);
    coarse = fine;
    weight *= detail;
  }
  if (bright_is_deep) height = -height;
  height = height({across, down, colour.width, colour.height}).clone();
  const float low = quantile_of(height, 0.005), high = quantile_of(height, 0.995);
  // Of one brightness; what a blur leaves of it is rounding, more or less of it by the library.
  const double rounding = 1e-5 * cv::norm(brightness, cv::NORM_INF);
  if (!(high - low > rounding)) return Image(colour.size(), 1, 0.5f);
  Image result = image_of((height - low) / (high - low));
  for (float& value : result.pixels) value = std::clamp(value, 0.0f, 1.0f);
  return result;
}

Image roughness_guess(const Image& height, double mean, double contrast) {
  double sum = 0;
  for (const float h : height.pixels) sum += double{h};
  const double middle = sum / static_cast<double>(height.pixels.size());
  Image result = height;
  for (float& value : result.pixels)
    value = static_cast<float>(std::clamp(mean + contrast * (middle - double{value}), 0.0, 1.0));
  return result;
}

std::map<std::string, Image> material_from_photo(const Image& photo, const PhotoParams& params) {
  check_fields(params);
  if (photo.channels != 1 && photo.channels != 3 && photo.channels != 4)
    throw Error("a photograph has {} channels, allowed are 1, 3 or 4", photo.channels);
  const Image flat =
      params.corners.empty() ? photo : set_right(photo, params.corners, params.photo_size);
  std::map<std::string, Image> maps;
  Image colour = without_shading(flat, params.light_scale, params.light_amount, params.cast);
  maps["height"] =
      height_guess(colour, params.height_scale, params.height_detail, params.bright_is_deep);
  maps["roughness"] = roughness_guess(maps["height"], params.roughness, params.roughness_contrast);
  maps["colour"] = std::move(colour);
  return maps;
}

}  // namespace gramloom
