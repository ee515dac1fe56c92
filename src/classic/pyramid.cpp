#include "classic/pyramid.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "classic/pyramid_blend.h"
#include "classic/pyramid_statistics.h"
#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/layer_axes.h"
#include "signal/steerable_pyramid.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Bands that are matched before they are added up: no more than can be worked on at once, since
/// each takes as much memory as an image. They are added in their order, whatever this number.
std::size_t bands_at_once() { return static_cast<std::size_t>(thread_count()); }

/// body(index) for bands first to last − 1 of a pyramid, in parallel.
template <class Body>
void for_each_band(std::size_t first, std::size_t last, const Body& body) {
  parallel_for(static_cast<std::int64_t>(last - first), 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto b = begin; b < end; ++b) body(first + static_cast<std::size_t>(b));
               });
}

/// The columns of a plane's coefficients that count, and these as a whole matrix again.
cv::Mat half_of(const cv::Mat& coefficients) {
  return coefficients.colRange(0, coefficients.cols / 2 + 1).clone();
}
cv::Mat whole_of(const cv::Mat& half, cv::Size size) {
  cv::Mat coefficients = cv::Mat::zeros(size, half.type());
  half.copyTo(coefficients.colRange(0, half.cols));
  return coefficients;
}

/// One round: bands get their histograms, the image is put together again and gets its own.
void match(cv::Mat& plane, const SteerablePyramid& pyramid, const PyramidStatistics& statistics,
           const std::vector<PyramidHistograms>& histograms) {
  const cv::Size size = plane.size();
  cv::Mat coefficients = half_of(fourier_coefficients(std::move(plane)));
  cv::Mat sum = cv::Mat::zeros(coefficients.size(), coefficients.type());
  for (std::size_t first = 0; first < pyramid.bands.size(); first += bands_at_once()) {
    const std::size_t last = std::min(first + bands_at_once(), pyramid.bands.size());
    std::vector<cv::Mat> matched(last - first);
    for_each_band(first, last, [&](std::size_t b) {
      cv::Mat band = band_of(coefficients, pyramid.bands[b]);
      statistics.match_band(band, histograms, b);
      matched[b - first] = half_of(fourier_coefficients(std::move(band)));
    });
    for (std::size_t b = first; b < last; ++b) add_band(sum, matched[b - first], pyramid.bands[b]);
  }
  coefficients.release();
  plane = from_fourier_coefficients(whole_of(sum, size));
  statistics.match_plane(plane, histograms);
}

/// White noise. Only the order of its values matters: they are given a histogram next.
cv::Mat white_noise(Size size, Random random) {
  cv::Mat plane(size.height, size.width, CV_32F);
  parallel_for(size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y) {
      Random row = random.stream(static_cast<std::uint64_t>(y));
      for (int x = 0; x < size.width; ++x) plane.at<float>(y, x) = row.uniform();
    }
  });
  return plane;
}

/// As many levels as wanted, while the coarsest still has a few samples on the longer side.
int usable_levels(int wanted, const std::vector<Exemplar>& exemplars, Size period) {
  int side = std::max(period.width, period.height);
  for (const Exemplar& exemplar : exemplars)
    side = std::min(side, std::max(exemplar.image.width, exemplar.image.height));
  int levels = 1;
  while (levels < wanted && (side >> (levels + 1)) >= 4) ++levels;
  return levels;
}

/// The size of the periodic picture to make, which no exemplar's sides exceed if it doesn't tile.
Size period_of(const Request& request) {
  const Target& target = request.target;
  Size period{1, 1};
  for (const Exemplar& exemplar : request.exemplars) {
    const Size own{period_for(exemplar.image.width, target.size.width, tiles_x(target.tile)),
                   period_for(exemplar.image.height, target.size.height, tiles_y(target.tile))};
    period = {std::max(period.width, own.width), std::max(period.height, own.height)};
  }
  return period;
}

using Report = std::function<void()>;  // called after each round of each channel

/// A texture of the exemplars with these shares (see PyramidStatistics).
Image make_texture(const PyramidParams& params, const Request& request,
                   const std::vector<Exemplar>& exemplars, const std::vector<double>& shares,
                   const Report& report) {
  const int channels = exemplars.front().image.channels;
  const Size period = period_of(request);
  const int levels = usable_levels(params.levels, exemplars, period);
  const PyramidStatistics statistics(exemplars, shares, levels, params.orientations);
  const auto to = steerable_pyramid(period, levels, params.orientations);
  const LayerAxes& layers = statistics.axes();
  std::vector<cv::Mat> planes;
  for (int c = 0; c < channels; ++c) {
    const bool flat = layers.is_flat(c);  // stays 0, as whitened
    cv::Mat plane;
    std::vector<PyramidHistograms> histograms;
    if (!flat) {
      histograms = statistics.of_axis(c);
      plane = white_noise(period, request.random.stream(static_cast<std::uint64_t>(c)));
      statistics.match_plane(plane, histograms);
    }
    for (int i = 0; i < params.iterations; ++i) {
      if (!flat) match(plane, to, statistics, histograms);
      report();
    }
    planes.push_back(plane);
  }
  Image result(request.target.size, channels);
  for (int c = 0; c < channels; ++c) {
    cv::Mat& plane = planes[static_cast<std::size_t>(c)];
    if (!plane.empty()) set_channel(result, c, plane);
    plane.release();
  }
  result = unwhitened(result, layers);
  statistics.match_channels(result);
  return result;
}

std::vector<double> shares_at(const Image& weights, int x, int y) {
  const float* here = map_at(weights, x, y);
  std::vector<double> shares(here, here + weights.channels);
  double sum = 0;
  for (const double share : shares) sum += share;
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

Texture synthesise(const PyramidParams& params, const Request& request, const Control& control) {
  check_request<PyramidParams>(request);
  const std::vector<Exemplar>& exemplars = request.exemplars;
  const Image& weights = request.target.weights;
  const bool weighed = exemplars.size() > 1 && !weights.empty();
  const bool everywhere = weights.size() == Size{1, 1};
  const std::size_t textures = weighed && !everywhere ? exemplars.size() : 1;
  const std::int64_t steps = std::int64_t{exemplars.front().image.channels} * params.iterations *
                             static_cast<std::int64_t>(textures);
  std::int64_t step = 0;
  control.step(step, steps);
  const auto report = [&] { control.step(++step, steps); };
  if (textures == 1) {
    const std::vector<double> shares = weighed ? shares_at(weights, 0, 0) : std::vector<double>{};
    return {make_texture(params, request, exemplars, shares, report), {}};
  }
  std::vector<Image> each;
  for (const Exemplar& exemplar : exemplars)
    each.push_back(make_texture(params, request, {exemplar}, {}, report));
  return {blended_by_weights(each, weights), {}};
}

Cost estimate(const PyramidParams& params, const RequestSize& request) {
  check_request<PyramidParams>(request);
  const int channels = request.exemplars.front().channels;
  Size period = request.size;
  double in = 0;
  for (const ExemplarSize& exemplar : request.exemplars) {
    in += static_cast<double>(exemplar.size.width) * exemplar.size.height;
    period = {std::max(period.width, exemplar.size.width),
              std::max(period.height, exemplar.size.height)};
  }
  const double out = static_cast<double>(period.width) * period.height;
  // With weights perhaps one texture for each exemplar.
  const double textures = request.weights ? static_cast<double>(request.exemplars.size()) : 1;
  // Samples of all bands, in images: level 0 and the high-pass in full, a quarter a level down.
  const double bands = params.orientations * 4.0 / 3 + 1.1;
  const auto in_flight = static_cast<double>(bands_at_once());
  // Filters 2 bytes a sample; the spectrum, the sum and matched bands 4 each; bands in flight with
  // what sorting needs 14.
  return {4 * channels * 2 * (in + out) + out * (8 + 2 * bands + 18 * in_flight) +
              (textures - 1) * 4 * channels * out,
          {.shared = textures * channels * params.iterations * 6e-8 * bands * out}};
}

}  // namespace gramloom
