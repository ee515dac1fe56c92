#include "classic/pyramid.h"

#include <algorithm>
#include <span>
#include <vector>

#include "classic/check_input.h"
#include "classic/fourier.h"
#include "classic/steerable_pyramid.h"
#include "core/colour_pca.h"
#include "core/histogram_match.h"
#include "core/threads.h"

namespace gramloom {

namespace {

std::span<float> values_of(cv::Mat& plane) { return {plane.ptr<float>(), plane.total()}; }

/// body(index) for each band of a pyramid, in parallel.
template <class Body>
void for_each_band(const SteerablePyramid& pyramid, const Body& body) {
  parallel_for(static_cast<std::int64_t>(pyramid.bands.size()), 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end);
                      ++b)
                   body(b);
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
  for_each_band(pyramid, [&](std::size_t b) {
    cv::Mat band = band_of(coefficients, pyramid.bands[b]);
    histograms.bands[b] = sorted_values(values_of(band));
  });
  return histograms;
}

/// One round: bands get their histograms, the image is put together again and gets its own.
void match(cv::Mat& plane, const SteerablePyramid& pyramid, const Histograms& histograms) {
  cv::Mat coefficients = fourier_coefficients(plane);
  std::vector<cv::Mat> matched(pyramid.bands.size());
  for_each_band(pyramid, [&](std::size_t b) {
    cv::Mat band = band_of(coefficients, pyramid.bands[b]);
    match_values(values_of(band), histograms.bands[b]);
    matched[b] = fourier_coefficients(band);
  });
  coefficients.setTo(0);
  for (std::size_t b = 0; b < matched.size(); ++b)
    add_band(coefficients, matched[b], pyramid.bands[b]);
  plane = from_fourier_coefficients(coefficients);
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

Texture synthesise(const PyramidParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_input(exemplar, target);
  const Size period{period_for(exemplar.width, target.size.width, tiles_x(target.tile)),
                    period_for(exemplar.height, target.size.height, tiles_y(target.tile))};
  const std::int64_t steps = std::int64_t{exemplar.channels} * params.iterations;
  control.step(0, steps);

  const int levels = usable_levels(params.levels, exemplar.size(), period);
  const auto from = steerable_pyramid(exemplar.size(), levels, params.orientations);
  const auto to = steerable_pyramid(period, levels, params.orientations);
  const ColourPca pca = colour_pca(exemplar);
  const Image axes = whitened(exemplar, pca);
  Image result(target.size, exemplar.channels);
  for (int c = 0; c < exemplar.channels; ++c) {
    const bool flat = pca.deviation[static_cast<std::size_t>(c)] == 0;  // stays 0, as whitened
    cv::Mat plane;
    Histograms histograms;
    if (!flat) {
      histograms = analyse(channel_plane(axes, c), from);
      plane = white_noise(period, random.stream(static_cast<std::uint64_t>(c)));
      match_values(values_of(plane), histograms.pixels);
    }
    for (int i = 0; i < params.iterations; ++i) {
      if (!flat) match(plane, to, histograms);
      control.step(std::int64_t{c} * params.iterations + i + 1, steps);
    }
    if (!flat) set_channel(result, c, plane);
  }
  result = unwhitened(result, pca);
  match_histogram(result, exemplar);
  return {std::move(result), {}};
}

Cost estimate(const PyramidParams& params, Size exemplar, int channels, const Target& target) {
  const double in = static_cast<double>(exemplar.width) * exemplar.height;
  const double out = static_cast<double>(std::max(target.size.width, exemplar.width)) *
                     std::max(target.size.height, exemplar.height);
  // Samples of all bands, in images: level 0 and the high-pass in full, a quarter a level down.
  const double bands = params.orientations * 4.0 / 3 + 1.1;
  const int in_flight = std::min(params.orientations + 1, thread_count());
  // Filters 2 bytes a sample, matched bands 8, bands in flight with what sorting needs 24.
  return {4 * channels * 2 * (in + out) + out * (16 + 10 * bands + 24 * in_flight),
          channels * params.iterations * 3e-8 * bands * out};
}

}  // namespace gramloom
