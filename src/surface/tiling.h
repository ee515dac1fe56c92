#pragma once

#include <string_view>
#include <tuple>
#include <vector>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// How pieces of the exemplar become one where they overlap.
enum class TileBlend {
  histogram,  // so that the exemplar's distribution of values stays (Heitz, Neyret 2018)
  contrast    // the higher or lighter piece shows (Mikkelsen 2022)
};
template <>
inline constexpr auto enum_names<TileBlend> = std::to_array<std::string_view>({"histogram",
                                                                               "contrast"});

/// Stochastic tiling: a triangle lattice over the result; at each of its points a hexagonal piece
/// from a random place of the exemplar; each pixel blends the three pieces around it. Any size, in
/// time that depends on nothing but that size, and no repetition. For irregular grain: grass,
/// gravel, sand. Rows of bricks are cut up, unless pieces are moved by whole bricks (`period`).
///
/// Heitz, Neyret 2018, "High-performance by-example noise using a histogram-preserving blending
/// operator"; Deliot, Heitz 2019, "Procedural stochastic textures by tiling and blending";
/// Burley 2019, "On histogram-preserving blending for randomized texture tiling" (weights to a
/// power); Mikkelsen 2022, "Practical real-time hex-tiling" (contrast and rotation).
/// Departures: see surface/tiling_lattice.h and surface/tiling_values.h.
///
/// Layers are blended by the same pieces and weights, so maps stay registered: of a colour and a
/// height that are of one pixel of the exemplar in the middle of a piece, and blended alike where
/// pieces meet.
///
/// Of a masked exemplar only pieces without a masked pixel are taken, and only usable pixels are
/// ranked; several exemplars, guides, weights and known pixels are refused.
struct TilingParams {
  static constexpr std::string_view kind = "tiling";
  static constexpr std::string_view summary =
      "hexagonal pieces from random places, blended (irregular grain, at any size)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::mask};

  double cell = 0.25;
  TileBlend blend = TileBlend::histogram;
  double sharpness = 4;
  double rotation = 0;
  Tile wraps = Tile::none;
  std::vector<double> period = {};

  static constexpr auto fields() {
    using P = TilingParams;
    return std::tuple{
        Field{"cell",
              &P::cell,
              "distance between the middles of pieces; larger keeps larger shapes",
              "share of the shorter side",
              {0.01, 0.5}},
        Field{"blend", &P::blend,
              "histogram keeps the distribution of values; contrast shows the higher piece (of a "
              "map called height), or the lighter one"},
        Field{"sharpness",
              &P::sharpness,
              "power of the weights: 1 blends over whole pieces, higher cuts between them",
              "",
              {1, 64}},
        Field{"rotation",
              &P::rotation,
              "pieces are turned by up to this, either way, and normals with them",
              "degrees",
              {0, 180}},
        Field{"wraps", &P::wraps,
              "edges at which the exemplar itself tiles, so that pieces may reach across them"},
        Field{
            "period",
            &P::period,
            "pieces are moved by multiples of these alone, across and down, so that rows of bricks "
            "go on: the distance from brick to brick",
            "pixels of the exemplar",
            {1, 65536}}};
  }
};

/// Throws Error for input that check_request() refuses, and for a `period` or `cell` that
/// make_lattice() (surface/stochastic_tiling.h) does.
Texture synthesise(const TilingParams& params, const Request& request, const Control& control);
Cost estimate(const TilingParams& params, const RequestSize& request);

}  // namespace gramloom
