#pragma once

#include <ATen/ATen.h>

#include "core/random.h"
#include "neural/loss/moments.h"
#include "neural/loss/picture_rows.h"

namespace gramloom::neural {

struct Guidance;

/// What terms are made from, on one level.
struct LossInput {
  const at::Tensor& exemplar;  // (channels, height, width)
  Target target;               // the result on this level
  int directions;              // NeuralParams::directions
  Random random;
  const Guidance* guidance = nullptr;  // of this level; none: the exemplar as a whole
  at::Tensor nearest = {};             // of a fill: nearest_places() for the largest of patch_sizes
  const Group& group = one_process();  // among which the result is shared out
};

/// A term of the loss that looks at the picture itself.
class PictureTerm {
 public:
  virtual ~PictureTerm() = default;
  /// Its value, unweighted, for a picture (channels, height, width), of which a process has its own
  /// rows; adds `weight` times the gradient of these. `step` matters to those that draw random
  /// numbers.
  virtual double add(const at::Tensor& picture, double weight, std::uint64_t step,
                     at::Tensor& gradient) const = 0;
};

/// What a term takes from the feature maps of some rows: moments of each layer, which are sums over
/// positions, or a value (of several) for each position, or both.
struct FeatureStatistics {
  std::vector<Moments> moments;
  std::vector<at::Tensor> values;  // (any, positions) of each layer, of each scale

  /// All tensors of the moments.
  std::vector<at::Tensor> sums() const;
};

/// A term that looks at the matched layers of a network, all rows of a picture at once or a few at
/// a time.
class FeatureTerm {
 public:
  virtual ~FeatureTerm() = default;
  /// The rows of a layer's maps at each scale that the statistics of rows `own` need.
  virtual std::vector<Rows> needed(const std::vector<Size>& sizes, const std::vector<Rows>& own,
                                   Tile wraps) const;
  /// What the own rows contribute.
  virtual FeatureStatistics statistics(const SeenRows& rows, Tile wraps,
                                       std::uint64_t step) const = 0;
  /// Takes the statistics of all of the exemplar as the goal.
  virtual void aim_at(FeatureStatistics exemplar) = 0;
  /// Whether the goal is another in each step.
  virtual bool aims_anew() const = 0;
  /// The error of each layer times its weight; `slopes` become its gradient along each tensor of
  /// the picture's statistics, undefined for none.
  virtual std::vector<double> compare(const FeatureStatistics& picture,
                                      const std::vector<double>& weights,
                                      FeatureStatistics& slopes) const = 0;
};

}  // namespace gramloom::neural
