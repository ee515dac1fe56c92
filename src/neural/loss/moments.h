#pragma once

#include "neural/network/rows.h"

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

/// What rows own[k] of each scale k contribute to these: shares that have all rows between them add
/// up to the whole. At least rows_for_moments() of them are held.
Moments moments(const std::vector<HeldRows>& scales, const std::vector<Rows>& own, Tile tile,
                const std::vector<int>& shifts);
/// sizes: of the whole maps of each scale.
std::vector<Rows> rows_for_moments(const std::vector<Size>& sizes, const std::vector<Rows>& own,
                                   Tile tile, const std::vector<int>& shifts);

}  // namespace gramloom::neural
