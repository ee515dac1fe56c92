#include "metrics/scores.h"

#include <algorithm>
#include <cmath>

#include "core/abilities.h"
#include "core/error.h"
#include "metrics/copying.h"
#include "metrics/exemplar_statistics.h"
#include "metrics/seams.h"
#include "metrics/spectrum.h"
#include "signal/correlation.h"

namespace gramloom {

namespace {

void check_image(const Image& exemplar, const Image& image) {
  if (image.empty()) throw Error("the image to score is empty");
  if (image.channels != exemplar.channels)
    throw Error("the image has {} channels, the exemplar {}: scores need the same number",
                image.channels, exemplar.channels);
  if (!std::all_of(image.pixels.begin(), image.pixels.end(),
                   [](float v) { return std::isfinite(v); }))
    throw Error("the image to score holds values that are not finite numbers");
}

/// The map of a picture that may have been continued to the smallest side.
Image cropped(const Image& map, Size size) {
  Image result(size, map.channels);
  for (int y = 0; y < size.height; ++y)
    std::copy_n(map.at(0, y), size.width * map.channels, result.at(0, y));
  return result;
}

}  // namespace

Scores score(ExemplarStatistics& exemplar, const Image& image, Tile tile, const Control& control,
             const SourceMap& source) {
  check_image(exemplar.exemplar(), image);
  constexpr std::int64_t steps = 7;
  std::int64_t step = 0;
  const auto next_step = [&] { control.step(step++, steps); };
  Scores scores;
  auto& values = scores.values;

  next_step();
  const Image& e = exemplar.components();
  const Image x = components(image, exemplar.frame());
  const int side = std::min(std::min(e.width, e.height), std::min(x.width, x.height));
  {
    const int levels = common_levels(e.size(), x.size());
    const auto& of_e = exemplar.of_bands(levels);
    const auto of_x = statistics_of_bands(x, levels);
    values.emplace_back("stsim2", stsim2(of_e.stsim, of_x.stsim));
    values.emplace_back("portilla_simoncelli", statistics_distance(of_e.texture, of_x.texture));
  }
  next_step();
  values.emplace_back("random_features", gram_distance(exemplar.features(), random_features(x)));
  next_step();
  values.emplace_back("patch_wasserstein",
                      patch_wasserstein(exemplar.patches(), patch_projections(x)));
  values.emplace_back(
      "colour_wasserstein",
      colour_wasserstein(exemplar.colours(), colour_projections(image, exemplar.frame().scale)));
  next_step();
  values.emplace_back("spectrum_db",
                      spectrum_distance(exemplar.rings(side), ring_densities(x, side)));
  double repeats = 0;  // more than the exemplar does
  {
    const auto& of_e = exemplar.self_correlation();
    const ShiftCorrelation of_x = shift_correlation(x, x);
    values.emplace_back("autocorrelation",
                        autocorrelation_distance(of_e.near, e.size(), of_x, x.size()));
    repeats = std::max(0.0, repetition(of_x, std::min(e.width, e.height)) - of_e.repetition);
  }
  next_step();
  values.emplace_back("copy_correlation", strongest_correlation(shift_correlation(x, e)));
  next_step();
  const Copying copies = copying(e, exemplar.tree(), x, source);
  values.emplace_back("copied_share", copies.share);
  values.emplace_back("copy_coherence", copies.coherence);
  values.emplace_back("repetition", repeats);
  if (tiles_x(tile)) values.emplace_back("seam_x", seam_visibility(image, true));
  if (tiles_y(tile)) values.emplace_back("seam_y", seam_visibility(image, false));
  scores.copy_map = cropped(copies.map, image.size());
  control.step(steps, steps);
  return scores;
}

Scores score(const Image& exemplar, const Image& image, Tile tile, const Control& control) {
  ExemplarStatistics statistics(exemplar);
  return score(statistics, image, tile, control);
}

Cost estimate_scores(Size exemplar, int channels, Size image) {
  const double of_exemplar = 1.0 * exemplar.width * exemplar.height;
  const double of_image = 1.0 * image.width * image.height;
  // The larger one's transforms take the most; measured from 256² to 2048².
  return {3e7 + 300 * std::max(of_exemplar, of_image) + 12.0 * channels * (of_exemplar + of_image),
          {.serial = 0.1, .shared = 3.5e-6 * (of_exemplar + of_image)}};
}

Cost estimate_diversity(Size image, int channels, int seeds) {
  const double pixels = 1.0 * image.width * image.height;
  const double pairs = 0.5 * seeds * (seeds - 1);
  // All results and their components; and the transforms of a pair.
  return {3e7 + pixels * (8.0 * channels * seeds + 150),
          {.serial = 0.02, .shared = pairs * 7e-7 * pixels}};
}

double diversity(std::span<const Image> seeds, const Control& control) {
  if (seeds.size() < 2) throw Error("diversity needs the results of at least two seeds");
  check_picture(seeds.front());
  const ColourFrame frame = colour_frame(seeds.front());
  std::vector<Image> pictures;
  for (const Image& seed : seeds) {
    check_image(seeds.front(), seed);
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
