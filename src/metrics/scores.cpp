#include "metrics/scores.h"

#include <algorithm>
#include <cmath>

#include "classic/check_input.h"
#include "core/error.h"
#include "metrics/bands.h"
#include "metrics/components.h"
#include "metrics/copying.h"
#include "metrics/portilla_simoncelli.h"
#include "metrics/random_features.h"
#include "metrics/seams.h"
#include "metrics/spectrum.h"
#include "metrics/stsim.h"
#include "metrics/wasserstein.h"
#include "signal/correlation.h"
#include "signal/fourier.h"

namespace gramloom {

namespace {

void check_pair(const Image& exemplar, const Image& image) {
  check_input(exemplar, Target{exemplar.size()});
  if (image.empty()) throw Error("the image to score is empty");
  if (image.channels != exemplar.channels)
    throw Error("the image has {} channels, the exemplar {}: scores need the same number",
                image.channels, exemplar.channels);
  if (!std::all_of(image.pixels.begin(), image.pixels.end(),
                   [](float v) { return std::isfinite(v); }))
    throw Error("the image to score holds values that are not finite numbers");
}

using Values = std::vector<std::pair<std::string_view, double>>;

void add_pyramid_scores(Values& values, const Image& exemplar, const Image& image) {
  const int levels = common_levels(exemplar.size(), image.size());
  const cv::Mat e = channel_plane(exemplar, 0), x = channel_plane(image, 0);
  const Bands of_e = bands_of(e, levels), of_x = bands_of(x, levels);
  values.emplace_back("stsim2", stsim2(of_e, of_x));
  values.emplace_back("portilla_simoncelli", statistics_distance(texture_statistics(e, of_e),
                                                                 texture_statistics(x, of_x)));
}

/// How much more the image repeats itself, and the distance of the self-correlations.
struct SelfCorrelation {
  double distance = 0;
  double repetition = 0;
};
SelfCorrelation self_correlation(const Image& exemplar, const Image& image) {
  const ShiftCorrelation e = shift_correlation(exemplar, exemplar);
  const ShiftCorrelation x = shift_correlation(image, image);
  const int side = std::min(exemplar.width, exemplar.height);
  return {autocorrelation_distance(e, exemplar.size(), x, image.size()),
          std::max(0.0, repetition(x, side) - repetition(e, side))};
}

}  // namespace

Scores score(const Image& exemplar, const Image& image, Tile tile, const Control& control) {
  check_pair(exemplar, image);
  constexpr std::int64_t steps = 7;
  std::int64_t step = 0;
  const auto next_step = [&] { control.step(step++, steps); };
  Scores scores;
  Values& values = scores.values;

  next_step();
  const ColourFrame frame = colour_frame(exemplar);
  const Image e = components(exemplar, frame), x = components(image, frame);
  add_pyramid_scores(values, e, x);
  next_step();
  values.emplace_back("random_features", gram_distance(random_features(e), random_features(x)));
  next_step();
  values.emplace_back("patch_wasserstein", patch_wasserstein(e, x));
  values.emplace_back("colour_wasserstein", colour_wasserstein(exemplar, image, frame.scale));
  next_step();
  values.emplace_back("spectrum_db", spectrum_distance(e, x));
  const SelfCorrelation self = self_correlation(e, x);
  values.emplace_back("autocorrelation", self.distance);
  next_step();
  values.emplace_back("copy_correlation", strongest_correlation(shift_correlation(x, e)));
  next_step();
  Copying copies = copying(e, x);
  values.emplace_back("copied_share", copies.share);
  values.emplace_back("copy_coherence", copies.coherence);
  values.emplace_back("repetition", self.repetition);
  if (tiles_x(tile)) values.emplace_back("seam_x", seam_visibility(image, true));
  if (tiles_y(tile)) values.emplace_back("seam_y", seam_visibility(image, false));

  scores.copy_map = Image(image.size(), copies.map.channels);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(copies.map.at(0, y), image.width * copies.map.channels, scores.copy_map.at(0, y));
  control.step(steps, steps);
  return scores;
}

Cost estimate_scores(Size exemplar, int channels, Size image) {
  const double of_exemplar = 1.0 * exemplar.width * exemplar.height;
  const double of_image = 1.0 * image.width * image.height;
  // The larger one's transforms take the most; measured from 256² to 2048².
  return {3e7 + 300 * std::max(of_exemplar, of_image) + 12.0 * channels * (of_exemplar + of_image),
          0.1 + 3.5e-6 * (of_exemplar + of_image)};
}

Cost estimate_diversity(Size image, int channels, int seeds) {
  const double pixels = 1.0 * image.width * image.height;
  const double pairs = 0.5 * seeds * (seeds - 1);
  // All results and their components; and the transforms of a pair.
  return {3e7 + pixels * (8.0 * channels * seeds + 150), 0.02 + pairs * 7e-7 * pixels};
}

double diversity(std::span<const Image> seeds, const Control& control) {
  if (seeds.size() < 2) throw Error("diversity needs the results of at least two seeds");
  const ColourFrame frame = colour_frame(seeds.front());
  std::vector<Image> pictures;
  for (const Image& seed : seeds) {
    check_pair(seeds.front(), seed);
    pictures.push_back(components(seed, frame));
  }
  const auto count = static_cast<std::int64_t>(pictures.size());
  const std::int64_t pairs = count * (count - 1) / 2;
  std::int64_t pair = 0;
  double sum = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (std::size_t j = i + 1; j < pictures.size(); ++j) {
      control.step(pair++, pairs);
      sum += strongest_correlation(shift_correlation(pictures[i], pictures[j]));
    }
  return 1 - sum / static_cast<double>(pairs);
}

}  // namespace gramloom
