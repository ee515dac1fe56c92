#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/image.h"
#include "metrics/components.h"
#include "metrics/portilla_simoncelli.h"
#include "metrics/random_features.h"
#include "metrics/stsim.h"
#include "metrics/wasserstein.h"
#include "signal/correlation.h"
#include "signal/patch_tree.h"

namespace gramloom {

/// The exemplar's side of all scores, for any number of images: each part is computed when it is
/// first asked for, and kept. About 60 bytes a pixel and up to 20 MB more. For one thread at a
/// time.
class ExemplarStatistics {
 public:
  /// Throws Error for an exemplar that is empty, has more than 64 channels or values that are not
  /// finite.
  explicit ExemplarStatistics(Image exemplar);

  const Image& exemplar() const { return exemplar_; }
  const ColourFrame& frame() const { return frame_; }
  const Image& components() const { return components_; }

  struct OfBands {
    StsimStatistics stsim;
    TextureStatistics texture;
  };
  const OfBands& of_bands(int levels);
  const RandomFeatures& features();
  const std::vector<Projections>& patches();
  const Projections& colours();
  const std::vector<double>& rings(int side);

  struct SelfCorrelation {
    ShiftCorrelation near;  // shifts up to a quarter of the sides, downwards
    double repetition = 0;
  };
  const SelfCorrelation& self_correlation();
  const PatchTree& tree();

 private:
  Image exemplar_;
  ColourFrame frame_;
  Image components_;
  std::map<int, OfBands> of_bands_;
  std::optional<RandomFeatures> features_;
  std::optional<std::vector<Projections>> patches_;
  std::optional<Projections> colours_;
  std::map<int, std::vector<double>> rings_;
  std::optional<SelfCorrelation> self_correlation_;
  std::optional<PatchTree> tree_;
};

/// Of a picture of components.
ExemplarStatistics::OfBands statistics_of_bands(const Image& components, int levels);

}  // namespace gramloom
