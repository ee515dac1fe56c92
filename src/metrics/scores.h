#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

class ExemplarStatistics;

/// What a score is, which way is better and what fools it: for tables, `gramloom list` and docs.
struct Metric {
  std::string_view name;   // in JSON and CSV
  std::string_view group;  // "likeness", "copying", "repetition", "seams" or "diversity"
  std::string_view meaning;
  std::string_view range;
  bool higher_is_better = false;
  std::string_view paper;
  std::string_view fooled_by;
  double best = 0;  // a score at or beyond it cannot be improved
};

/// Every metric, in the order of tables. Likeness comes first: "stsim2", "portilla_simoncelli" and
/// "random_features" take in structure, so that neither shuffled pixels nor random phase fool them;
/// "patch_wasserstein" barely notices random phase, and "colour_wasserstein", "spectrum_db" and
/// "autocorrelation" each measure one thing and are blind to the rest.
std::span<const Metric> metrics();

struct Scores {
  /// By name, in metrics()' order. A seam score is there for an axis that tiles, "diversity" never
  /// (see diversity()).
  std::vector<std::pair<std::string_view, double>> values;
  /// Where each pixel came from, of the image's size with 3 channels in [0, 1]: red grows with the
  /// exemplar's x, green with its y, blue against both. Pixels in copied blocks are at full
  /// brightness, others at a third. Of a picture whose method does not tell, it is the likest
  /// place.
  Image copy_map;
};

/// Scores of an image, of any size, against an exemplar, whose part is computed once for all images
/// (exemplar_statistics.h) or for this one; `tile`: the axes on which it claims to
/// tile. The same bytes for any number of threads. Sides under 16 pixels are continued by mirroring
/// (except for seams). Throws Error for an empty image, more than 64 channels, values that are not
/// finite, or different numbers of channels; Interrupted when `control` asks to stop.
/// `source` is what the image's method says of where its pixels are from: the copy map then shows
/// that instead of the likest places. The scores are the same with and without it.
Scores score(ExemplarStatistics& exemplar, const Image& image, Tile tile,
             const Control& control = {}, const SourceMap& source = {});
Scores score(const Image& exemplar, const Image& image, Tile tile, const Control& control = {});

/// What score() is expected to need.
Cost estimate_scores(Size exemplar, int channels, Size image);

/// How different results of several seeds are: 1 − the mean, over all pairs, of the strongest
/// correlation at any shift (copying.h's), between 0 (the same picture, however shifted) and 1.
/// Throws Error for fewer than two images or different numbers of channels; Interrupted when
/// `control` asks to stop.
double diversity(std::span<const Image> seeds, const Control& control = {});

/// What diversity() of that many results of this size is expected to need.
Cost estimate_diversity(Size image, int channels, int seeds);

}  // namespace gramloom
