#pragma once

#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// Image quilting (Efros & Freeman 2001, "Image quilting for texture synthesis and transfer"):
/// patches of the exemplar are laid on a grid so that they overlap; each is drawn from those whose
/// overlap error is within `tolerance` of the best one, and cut to its neighbours along the path of
/// least error. Departures from the paper:
/// - of several patches drawn so, the one with the best cut is laid: the overlap error alone counts
///   a joint that ends in the middle of a brick for little;
/// - overlaps are wide, 0.45 of a patch instead of 1/6: a narrow one inside a brick cannot tell how
///   high that brick is to become;
/// - errors grow with how often a piece has been laid, so that it does not recur side by side;
/// - a quilt at a quarter of the resolution, the best of several, guides the choice: laid one by
///   one, rows drift and would not meet where the texture tiles;
/// - where two sides meet, each has a cut of its own and the patch keeps what lies inside both;
/// - on an axis that tiles, the last patch is also matched and cut to the first one's other side;
/// - patches are laid in the order column + 2 · row instead of row by row, so that several can be
///   laid at once (each still sees its left, upper left, upper and upper right neighbours);
/// - patches shrink a little so that a whole number of them fills the texture.
///
/// Several exemplars and masks: patches are taken from where all of their pixels may be used, and
/// are small enough that each exemplar has such places.
/// Guide: the distance of the guides of the whole patch is added to its overlap error, each per
/// pixel (Efros & Freeman 2001, section 3, without their passes of smaller and smaller patches);
/// then pixels that miss their label are made again (see classic/quilt_labels.h). Weights of
/// exemplars are a guide.
/// Fill: only patches that touch a hole are laid, and known pixels under one are its overlap
/// whatever their shape, less with their distance from the hole; the cut through patches laid
/// before is a minimum cut of a graph (Kwatra et al. 2003, "Graphcut textures").
struct QuiltingParams {
  static constexpr std::string_view kind = "quilting";
  static constexpr std::string_view summary =
      "overlapping patches cut along the path of least error (Efros & Freeman 2001)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::guide,    Ability::mix,       Ability::fill,
                                       Ability::source};

  int patch_size = 0;
  double overlap = 0.45;
  double tolerance = 0.1;
  int candidates = 4;
  double variety = 0.02;
  double guidance = 0.05;
  int feather = 0;

  static constexpr auto fields() {
    using P = QuiltingParams;
    return std::tuple{
        Field{"patch_size",
              &P::patch_size,
              "side of a patch; at most three quarters of the exemplar's side are used; 0: three "
              "eighths of its shorter side, a quarter with a guide, and at most 64 where known "
              "pixels are kept",
              "pixels",
              {0, 1024}},
        Field{"overlap",
              &P::overlap,
              "part of a patch's side that overlaps its neighbour",
              "",
              {0, 0.5}},
        Field{"tolerance",
              &P::tolerance,
              "patches are drawn from those with an error up to (1 + tolerance) times the least",
              "",
              {0, 100}},
        Field{"candidates",
              &P::candidates,
              "patches that are drawn for each place, of which the one with the best cut is laid",
              "",
              {1, 1000}},
        Field{"variety",
              &P::variety,
              "how strongly pieces of the exemplar that have been laid already are avoided",
              "",
              {0, 100}},
        Field{"guidance",
              &P::guidance,
              "how strongly patches keep to the best of several quilts at a quarter of the "
              "resolution",
              "",
              {0, 100}},
        Field{"feather",
              &P::feather,
              "blend along the cuts over this many pixels on both sides; 0: every pixel is one of "
              "the exemplar's",
              "pixels",
              {0, 64}},
    };
  }
};

/// The texture. An exemplar smaller than a patch makes the patches smaller. With `feather`, pixels
/// along the cuts are blended: their source is that of the piece that they have more of.
/// Throws Error for an empty exemplar or target, Interrupted when `control` asks to stop.
Texture synthesise(const QuiltingParams& params, const Request& request, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const QuiltingParams& params, const RequestSize& request);

}  // namespace gramloom
