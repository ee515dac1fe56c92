#pragma once

#include "neural/network/bands.h"

namespace gramloom::neural {

/// Second moments of feature maps over positions: gram = F Fᵀ / M, (channels, channels), and the
/// means of the maps, (channels). Sums over positions, so neither order nor number matters.
struct Moments {
  at::Tensor gram;
  at::Tensor mean;

  /// Products of maps with maps that are shifted, of one scale: its channels from `first` on.
  struct Shifted {
    std::int64_t first, dy, dx;
    at::Tensor products;  // (channels of the scale, the same)
  };
  std::vector<Shifted> shifted;
};

/// One matrix product; its gradient (∂gram + ∂gramᵀ) F / M is one more.
Moments moments(const FeatureMaps& maps);

/// The same over all maps of all scales. Maps of two scales meet at the coarser one's positions,
/// where the finer one is averaged: what coarse maps, which are smooth, would give at every fine
/// position, for a fraction of the work.
/// tile: the edges across which maps go on.
/// shifts: for each distance d, also the products with the same maps shifted by (d, 0), (0, d),
/// (d, d) and (d, −d) positions, each scale with itself (Brochard, Zhang, Mallat 2022, "Generalized
/// rectifier wavelet covariance models for texture synthesis", equation 5); not on scales of less
/// than 2 d positions.
Moments moments(const Scales& scales, Tile tile, const std::vector<int>& shifts = {});

/// What rows own[k] of each scale k contribute to these: parts that have all rows between them add
/// up to the whole. The bands hold at least rows_for_moments() of them.
Moments moments(const std::vector<Band>& scales, const std::vector<Rows>& own, Tile tile,
                const std::vector<int>& shifts);
/// sizes: of the whole maps of each scale.
std::vector<Rows> rows_for_moments(const std::vector<Size>& sizes, const std::vector<Rows>& own,
                                   Tile tile, const std::vector<int>& shifts);

/// How the Gram matrices of one layer are compared.
struct GramOptions {
  bool normalise = true;
  bool centre = true;
  bool standardise = true;
  std::vector<int> shifts;  // of the moments
};

/// What one layer of the exemplar has, and how far a result is from it:
///   E = 1/(4 N²) Σ (G − Ĝ)²
/// with Gram matrices divided by the number of positions M (Gatys, Ecker, Bethge 2015, equation 3,
/// whose 1/(4 N² M²) is this for M equal on both sides). Departures, each by its option:
///   centre:      F is replaced by F − μ̂ with the exemplar's means μ̂, and E gains the means'
///                difference, 2/(4 N²) Σ (μ − μ̂)², as if a constant map 1 had joined F;
///   standardise: each map is divided by its standard deviation on the exemplar (about 0 when
///                not centred);
///   shifts:      products of shifted maps are compared like those of G;
///   normalise:   E is divided by its value for G = 0, μ = μ̂, so that layers weigh alike.
class GramTarget {
 public:
  GramTarget(const Moments& exemplar, const GramOptions& options);
  /// E, a scalar.
  at::Tensor distance(const Moments& result) const;

 private:
  // `products` of the maps from `first` on, centred and standardised with the means of `m`.
  at::Tensor transformed(const at::Tensor& products, const Moments& m, std::int64_t first) const;

  GramOptions options_;
  at::Tensor mean_, inverse_deviation_, gram_;
  std::vector<Moments::Shifted> shifted_;  // centred and standardised
  double scale_ = 1;
};

}  // namespace gramloom::neural
