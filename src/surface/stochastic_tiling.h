#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "core/request.h"
#include "surface/tiling.h"
#include "surface/tiling_lattice.h"
#include "surface/tiling_values.h"

namespace gramloom {

/// The lattice that the params ask for, over a result of this size. Throws Error for a `period`
/// that is not two numbers, is given with a `rotation` or fits nowhere; and for a `cell` so large
/// that pieces would be nearly the same, or that none lies in usable pixels of a mask.
TilingLattice make_lattice(const TilingParams& params, Size exemplar, Size result, Tile tile,
                           Random random, const Image& mask = {});

/// A plane covered with pieces of an exemplar, without repetition (surface/tiling.h says how). It
/// is looked up at a point, or made row by row; either depends on nothing else that was made.
///
///   const StochasticTiling floor({picture}, {}, Random(1));
///   floor.at(1234.5, -20, values);
class StochasticTiling {
 public:
  /// Endless.
  StochasticTiling(const Exemplar& exemplar, const TilingParams& params, Random random);
  /// Which repeats every `size` pixels on the axes that tile.
  StochasticTiling(const Exemplar& exemplar, const TilingParams& params, Size size, Tile tile,
                   Random random);

  int channels() const { return values_.values().channels; }

  /// The exemplar's channels at a point, in pixels of the exemplar, whose middles are at ½; between
  /// them a cubic interpolates (Catmull, Rom 1974). |x| and |y| below 1e9.
  void at(double x, double y, float* values) const;

  /// Rows [first, first + count), of `width` pixels from x = 0 on, one after the other: what at()
  /// gives at the pixels' middles, to rounding. In parallel, the same bytes for any threads.
  void rows(int first, int count, int width, float* to) const;

 private:
  using Pieces = std::array<TilingPiece, 3>;
  std::array<float, 3> sharpened(std::array<float, 3> shares) const;
  void turn_slopes(const TilingPiece& piece, float* values) const;
  void blend_at(const Pieces& pieces, std::array<float, 3> shares, double x, double y,
                float* values) const;
  int run(int x, int y, int width, float* row) const;
  const float* straight(const TilingPiece& piece, const Image& wide, int x, int y) const;
  template <class SharesOf>
  void blend_straight(const Pieces& pieces, int x, int y, int count, float* to,
                      SharesOf&& shares_of) const;

  TilingParams params_;
  Size exemplar_;
  TilingLattice lattice_;
  TilingValues values_;
  Image wide_values_, wide_prominence_;  // the exemplar's, with columns to hold a piece at its edge
  std::vector<float> powers_;            // of weights from 0 to 1
};

}  // namespace gramloom
