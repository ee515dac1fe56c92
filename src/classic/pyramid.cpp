#include "classic/pyramid.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/histogram_match.h"
#include "signal/layer_axes.h"
#include "signal/steerable_pyramid.h"

namespace gramloom {

namespace {

/// Bands that are matched before they are added up: no more than can be worked on at once, since
/// each takes as much memory as an image. They are added in their order, whatever this number.
std::size_t bands_at_once() { return static_cast<std::size_t>(thread_count()); }

std::span<float> values_of(cv::Mat& plane) { return {plane.ptr<float>(), plane.total()}; }

/// body(index) for bands first to last − 1 of a pyramid, in parallel.
template <class Body>
void for_each_band(std::size_t first, std::size_t last, const Body& body) {
  parallel_for(static_cast<std::int64_t>(last - first), 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto b = begin; b < end; ++b) body(first + static_cast<std::size_t>(b));
               });
}

/// What is kept of one colour axis of the exemplar: its values and those of its bands, sorted.
struct Histograms {
  std::vector<float> pixels;
  std::vector<std::vector<float>> bands;
};

Histograms analyse(cv::Mat plane, const SteerablePyramid& pyramid) {
  Histograms histograms{sorted_values(values_of(plane)), {}};
  histograms.bands.resize(pyramid.bands.size());
  const cv::Mat coefficients = periodic_coefficients(plane);
  for_each_band(0, pyramid.bands.size(), [&](std::size_t b) {
    cv::Mat band = band_of(coefficients, pyramid.bands[b]);
    histograms.bands[b] = sorted_values(values_of(band));
  });
  return histograms;
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
void match(cv::Mat& plane, const SteerablePyramid& pyramid, const Histograms& histograms) {
  const cv::Size size = plane.size();
  cv::Mat coefficients = half_of(fourier_coefficients(std::move(plane)));
  cv::Mat sum = cv::Mat::zeros(coefficients.size(), coefficients.type());
  for (std::size_t first = 0; first < pyramid.bands.size(); first += bands_at_once()) {
    const std::size_t last = std::min(first + bands_at_once(), pyramid.bands.size());
    std::vector<cv::Mat> matched(last - first);
    for_each_band(first, last, [&](std::size_t b) {
      cv::Mat band = band_of(coefficients, pyramid.bands[b]);
      match_values(values_of(band), histograms.bands[b]);
      matched[b - first] = half_of(fourier_coefficients(std::move(band)));
    });
    for (std::size_t b = first; b < last; ++b) add_band(sum, matched[b - first], pyramid.bands[b]);
  }
  coefficients.release();
  plane = from_fourier_coefficients(whole_of(sum, size));
  match_values(values_of(plane), histograms.pixels);
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
int usable_levels(int wanted, Size a, Size b) {
  const int side = std::min(std::max(a.width, a.height), std::max(b.width, b.height));
  int levels = 1;
  while (levels < wanted && (side >> (levels + 1)) >= 4) ++levels;
  return levels;
}

}  // namespace

Texture synthesise(const PyramidParams& params, const Request& request, const Control& control) {
  check_request<PyramidParams>(request);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  const Size period{period_for(exemplar.width, target.size.width, tiles_x(target.tile)),
                    period_for(exemplar.height, target.size.height, tiles_y(target.tile))};
  const std::int64_t steps = std::int64_t{exemplar.channels} * params.iterations;
  control.step(0, steps);

  const int levels = usable_levels(params.levels, exemplar.size(), period);
  const auto from = steerable_pyramid(exemplar.size(), levels, params.orientations);
  const auto to = steerable_pyramid(period, levels, params.orientations);
  const LayerAxes layers = layer_axes(exemplar, request.exemplars.front().layers);
  const Image axes = whitened(exemplar, layers);
  std::vector<cv::Mat> planes;
  for (int c = 0; c < exemplar.channels; ++c) {
    const bool flat = layers.is_flat(c);  // stays 0, as whitened
    cv::Mat plane;
    Histograms histograms;
    if (!flat) {
      histograms = analyse(channel_plane(axes, c), from);
      plane = white_noise(period, request.random.stream(static_cast<std::uint64_t>(c)));
      match_values(values_of(plane), histograms.pixels);
    }
    for (int i = 0; i < params.iterations; ++i) {
      if (!flat) match(plane, to, histograms);
      control.step(std::int64_t{c} * params.iterations + i + 1, steps);
    }
    planes.push_back(plane);
  }
  Image result(target.size, exemplar.channels);
  for (int c = 0; c < exemplar.channels; ++c) {
    cv::Mat& plane = planes[static_cast<std::size_t>(c)];
    if (!plane.empty()) set_channel(result, c, plane);
    plane.release();
  }
  result = unwhitened(result, layers);
  match_histogram(result, exemplar);
  return {std::move(result), {}};
}

Cost estimate(const PyramidParams& params, const RequestSize& request) {
  check_request<PyramidParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const double in = static_cast<double>(exemplar.width) * exemplar.height;
  const double out = static_cast<double>(std::max(request.size.width, exemplar.width)) *
                     std::max(request.size.height, exemplar.height);
  // Samples of all bands, in images: level 0 and the high-pass in full, a quarter a level down.
  const double bands = params.orientations * 4.0 / 3 + 1.1;
  const auto in_flight = static_cast<double>(bands_at_once());
  // Filters 2 bytes a sample; the spectrum, the sum and matched bands 4 each; bands in flight with
  // what sorting needs 14.
  return {4 * channels * 2 * (in + out) + out * (8 + 2 * bands + 18 * in_flight),
          channels * params.iterations * 3e-8 * bands * out};
}

}  // namespace gramloom
