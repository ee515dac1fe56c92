#pragma once

#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

/// Texture optimisation over all overlapping patches, coarse to fine: patches look for their like
/// in the exemplar (Barnes et al. 2009, "PatchMatch"), then the texture becomes what fits them best
/// (Kwatra et al. 2005, "Texture optimization for example-based synthesis"), in turn; regions used
/// too often are avoided (Kaspar et al. 2015, "Self tuning texture optimization"). Each pixel of
/// the result is one of the exemplar's. Departures from the papers:
/// - the coarsest level starts from a quilt (quilting.h) instead of noise, which keeps rows and
///   grids straight;
/// - patches are 8×8 on every level, of three principal components and a structure feature
///   (patch_features.h), which stands for Kaspar's guidance channel;
/// - a penalty on the size of a piece copied as a whole, besides the one on uneven use;
/// - a finer level starts from the origins of the coarser one, not from its enlarged picture.
///
/// Several exemplars, masks, weights, guides and fills are met by the same search and vote
/// (patchmatch_directed.h):
/// - only patches that lie wholly in usable pixels of one exemplar are copied, on every level:
/// there
///   are as many as leave each exemplar some. The first quilt is masked and guided, and makes as
///   much of each of several exemplars as it has;
/// - a guide's channels are compared as the features are, patch by patch, and once more when each
///   pixel is chosen, so that labels end where they are painted (Hertzmann et al. 2001, "Image
///   analogies", whose texture by numbers this is; weights of exemplars are such a guide, and those
///   that are everywhere the same become islands: signal/share_labels.h);
/// - a fill is that of Wexler, Shechtman, Irani 2007 ("Space-time completion of video"): known
///   pixels stay, and only patches that touch a hole are searched, those near known pixels with
///   the stronger votes. Departures: their coarsest level starts from what grows inward from the
///   holes' borders (Criminisi, Pérez, Toyama 2004, "Region filling and object removal by
///   exemplar-based image inpainting"); holes far apart are filled apart, each on as many levels as
///   it is wide; each pixel is one of the exemplar's, chosen so that pieces meet each other and the
///   known pixels where they are alike (Kwatra et al. 2003, "Graphcut textures").
struct PatchmatchParams {
  static constexpr std::string_view kind = "patchmatch";
  static constexpr std::string_view summary =
      "all overlapping patches optimised together, coarse to fine (Kwatra et al. 2005, Barnes et "
      "al. 2009, Kaspar et al. 2015)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::guide,    Ability::mix,       Ability::fill,
                                       Ability::source};

  int levels = 0;
  int iterations = 10;
  int tries = 4;
  double structure = 0.7;
  double uniformity = 0.3;
  double largest_copy = 0.15;

  static constexpr auto fields() {
    using P = PatchmatchParams;
    return std::tuple{
        Field{
            "levels",
            &P::levels,
            "levels of the pyramid, each half the size of the finer one; 0, or more than fit: down "
            "to an exemplar of 28 to 55 pixels",
            "",
            {0, 16}},
        Field{"iterations",
              &P::iterations,
              "searches and votes on the finest level; each coarser one has 12 more",
              "",
              {1, 1000}},
        Field{"tries", &P::tries, "random origins that a patch tries in each search", "", {0, 32}},
        Field{"structure",
              &P::structure,
              "weight of edges and lines, whatever their colours, against colours",
              "",
              {0, 10}},
        Field{"uniformity",
              &P::uniformity,
              "how strongly regions of the exemplar that are used too often are avoided",
              "",
              {0, 100}},
        Field{"largest_copy",
              &P::largest_copy,
              "part of the exemplar beyond which copying a piece as a whole is avoided",
              "",
              {0.001, 1000}},
    };
  }
};

/// The texture. An exemplar of fewer than 16 pixels on a side is continued by mirroring.
/// Progress counts iterations; the loss is Kwatra's robust energy on the current level.
/// In a fill `structure` counts nothing: a hole continues what is about it, to the colour. Nor do
/// `uniformity` and `largest_copy` unless there is more to make than to copy from.
/// Throws Error for an empty exemplar or target, or where masks leave no patch of 8×8 pixels whole;
/// Interrupted when `control` asks to stop.
Texture synthesise(const PatchmatchParams& params, const Request& request, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const PatchmatchParams& params, const RequestSize& request);

}  // namespace gramloom
