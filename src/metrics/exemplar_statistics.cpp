#include "metrics/exemplar_statistics.h"

#include <algorithm>
#include <utility>

#include "core/abilities.h"
#include "metrics/spectrum.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

template <class T, class Make>
const T& once(std::optional<T>& part, const Make& make) {
  if (!part) part = make();
  return *part;
}

template <class T, class Make>
const T& once(std::map<int, T>& parts, int key, const Make& make) {
  const auto found = parts.find(key);
  return found != parts.end() ? found->second : parts.emplace(key, make()).first->second;
}

const Image& checked(const Image& exemplar) {
  check_picture(exemplar);
  return exemplar;
}

ExemplarStatistics::SelfCorrelation correlate(const Image& image) {
  const ShiftCorrelation all = shift_correlation(image, image);
  const int right = image.width / 4, down = image.height / 4;
  const cv::Rect near{-right - all.left, -all.top, 2 * right + 1, down + 1};
  return {{all.values(near).clone(), -right, 0},
          repetition(all, std::min(image.width, image.height))};
}

}  // namespace

ExemplarStatistics::OfBands statistics_of_bands(const Image& components, int levels) {
  const cv::Mat plane = channel_plane(components, 0);
  const Bands bands = bands_of(plane, levels);
  return {stsim_statistics(bands), texture_statistics(plane, bands)};
}

ExemplarStatistics::ExemplarStatistics(Image exemplar)
    : exemplar_(std::move(exemplar)),
      frame_(colour_frame(checked(exemplar_))),
      components_(gramloom::components(exemplar_, frame_)) {}

const ExemplarStatistics::OfBands& ExemplarStatistics::of_bands(int levels) {
  return once(of_bands_, levels, [&] { return statistics_of_bands(components_, levels); });
}

const RandomFeatures& ExemplarStatistics::features() {
  return once(features_, [&] { return random_features(components_); });
}

const std::vector<Projections>& ExemplarStatistics::patches() {
  return once(patches_, [&] { return patch_projections(components_); });
}

const Projections& ExemplarStatistics::colours() {
  return once(colours_, [&] { return colour_projections(exemplar_, frame_.scale); });
}

const std::vector<double>& ExemplarStatistics::rings(int side) {
  return once(rings_, side, [&] { return ring_densities(components_, side); });
}

const ExemplarStatistics::SelfCorrelation& ExemplarStatistics::self_correlation() {
  return once(self_correlation_, [&] { return correlate(components_); });
}

const PatchTree& ExemplarStatistics::tree() {
  return once(tree_, [&] { return PatchTree(components_); });
}

}  // namespace gramloom
