#include "classic/pyramid_statistics.h"

#include <algorithm>
#include <utility>

#include "core/threads.h"
#include "signal/fourier.h"
#include "signal/histogram_match.h"
#include "signal/quantile.h"
#include "signal/united.h"

namespace gramloom {

namespace {

std::span<float> values_of(cv::Mat& plane) { return {plane.ptr<float>(), plane.total()}; }

bool is_usable(const Exemplar& exemplar, int x, int y) {
  return exemplar.mask.empty() || *exemplar.mask.at(x, y) > 0.5f;
}

/// The pixels of an exemplar that may be used, one after the other.
std::vector<const float*> usable_pixels(const Exemplar& exemplar) {
  std::vector<const float*> pixels;
  for (int y = 0; y < exemplar.image.height; ++y)
    for (int x = 0; x < exemplar.image.width; ++x)
      if (is_usable(exemplar, x, y)) pixels.push_back(exemplar.image.at(x, y));
  return pixels;
}

/// Those of all exemplars, as one row. centred: all get the mean of the first one's.
Image joined_pixels(const std::vector<Exemplar>& exemplars, bool centred) {
  const int channels = exemplars.front().image.channels;
  std::vector<float> values;
  std::vector<double> first;
  for (const Exemplar& exemplar : exemplars) {
    const auto pixels = usable_pixels(exemplar);
    std::vector<double> mean(static_cast<std::size_t>(channels));
    for (const float* pixel : pixels)
      for (std::size_t c = 0; c < mean.size(); ++c)
        mean[c] += double{pixel[c]} / static_cast<double>(pixels.size());
    if (first.empty()) first = mean;
    for (const float* pixel : pixels)
      for (std::size_t c = 0; c < mean.size(); ++c)
        values.push_back(pixel[c] + (centred ? static_cast<float>(first[c] - mean[c]) : 0));
  }
  Image image;
  image.width = static_cast<int>(values.size() / static_cast<std::size_t>(channels));
  image.height = 1;
  image.channels = channels;
  image.pixels = std::move(values);
  return image;
}

LayerAxes axes_of(const std::vector<Exemplar>& exemplars, bool mixes) {
  const Exemplar& first = exemplars.front();
  if (exemplars.size() == 1 && first.mask.empty()) return layer_axes(first.image, first.layers);
  return layer_axes(joined_pixels(exemplars, mixes), first.layers);
}

/// The samples of a plane on some grid over the exemplar whose place may be used; all where there
/// are none.
std::vector<float> usable_values(const cv::Mat& plane, const Exemplar& exemplar) {
  std::vector<float> values;
  values.reserve(plane.total());
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      if (is_usable(exemplar, x * exemplar.image.width / plane.cols,
                    y * exemplar.image.height / plane.rows))
        values.push_back(plane.at<float>(y, x));
  if (values.empty()) values.assign(plane.begin<float>(), plane.end<float>());
  return values;
}

void append(std::vector<float>& to, const std::vector<float>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<float> channel_values(const Image& image, int channel) {
  std::vector<float> values;
  for (std::size_t i = static_cast<std::size_t>(channel); i < image.pixels.size();
       i += static_cast<std::size_t>(image.channels))
    values.push_back(image.pixels[i]);
  return values;
}

}  // namespace

PyramidStatistics::PyramidStatistics(const std::vector<Exemplar>& exemplars,
                                     std::vector<double> shares, int levels, int orientations)
    : exemplars_(exemplars),
      shares_(std::move(shares)),
      axes_(axes_of(exemplars, !shares_.empty())) {
  for (const Exemplar& exemplar : exemplars)
    parts_.push_back(
        {exemplar,
         whitened(exemplar.mask.empty() ? exemplar.image : extended(exemplar.image, exemplar.mask),
                  axes_),
         steerable_pyramid(exemplar.image.size(), levels, orientations)});
}

PyramidHistograms PyramidStatistics::analyse(const Part& part, int axis) const {
  const cv::Mat plane = channel_plane(part.axes, axis);
  PyramidHistograms histograms{usable_values(plane, part.exemplar), {}};
  histograms.bands.resize(part.pyramid.bands.size());
  const cv::Mat coefficients = periodic_coefficients(plane);
  parallel_for(static_cast<std::int64_t>(histograms.bands.size()), 1,
               [&](std::int64_t begin, std::int64_t end) {
                 for (auto b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end);
                      ++b)
                   histograms.bands[b] =
                       usable_values(band_of(coefficients, part.pyramid.bands[b]), part.exemplar);
               });
  return histograms;
}

std::vector<PyramidHistograms> PyramidStatistics::of_axis(int axis) const {
  std::vector<PyramidHistograms> result;
  for (const Part& part : parts_) {
    PyramidHistograms own = analyse(part, axis);
    if (!shares_.empty() || result.empty()) {
      result.push_back(std::move(own));
      continue;
    }
    append(result.front().pixels, own.pixels);
    for (std::size_t b = 0; b < own.bands.size(); ++b)
      append(result.front().bands[b], own.bands[b]);
  }
  for (PyramidHistograms& histograms : result) {
    histograms.pixels = sorted_values(histograms.pixels);
    parallel_for(static_cast<std::int64_t>(histograms.bands.size()), 1,
                 [&](std::int64_t begin, std::int64_t end) {
                   for (auto b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end);
                        ++b)
                     histograms.bands[b] = sorted_values(histograms.bands[b]);
                 });
  }
  return result;
}

void PyramidStatistics::match(std::span<float> values, const Sorted& sorted) const {
  if (shares_.empty()) {
    match_values(values, *sorted.front());
    return;
  }
  std::vector<float> mixed(values.size());
  std::vector<Quantiles> quantiles;
  for (const std::vector<float>* own : sorted) quantiles.emplace_back(*own, mixed.size());
  for (std::size_t rank = 0; rank < mixed.size(); ++rank) {
    double value = 0;
    for (std::size_t e = 0; e < shares_.size(); ++e) value += shares_[e] * quantiles[e](rank);
    mixed[rank] = static_cast<float>(value);
  }
  match_values(values, mixed);
}

void PyramidStatistics::match_plane(cv::Mat& plane,
                                    const std::vector<PyramidHistograms>& histograms) const {
  Sorted sorted;
  for (const PyramidHistograms& own : histograms) sorted.push_back(&own.pixels);
  match(values_of(plane), sorted);
}

void PyramidStatistics::match_band(cv::Mat& band, const std::vector<PyramidHistograms>& histograms,
                                   std::size_t index) const {
  Sorted sorted;
  for (const PyramidHistograms& own : histograms) sorted.push_back(&own.bands[index]);
  match(values_of(band), sorted);
}

void PyramidStatistics::match_channels(Image& image) const {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<Image> pixels;  // of each exemplar, or of all
  if (shares_.empty())
    pixels.push_back(joined_pixels(exemplars_, false));
  else
    for (const Exemplar& exemplar : exemplars_) pixels.push_back(joined_pixels({exemplar}, false));
  parallel_for(image.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      std::vector<std::vector<float>> own;
      Sorted sorted;
      for (const Image& part : pixels) own.push_back(sorted_values(channel_values(part, c)));
      for (const std::vector<float>& values : own) sorted.push_back(&values);
      std::vector<float> values = channel_values(image, c);
      match(values, sorted);
      for (std::size_t i = 0; i < values.size(); ++i)
        image.pixels[i * channels + static_cast<std::size_t>(c)] = values[i];
    }
  });
}

}  // namespace gramloom
