#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"

namespace gramloom {

enum class PixelAlgorithm { lefebvre_hoppe, wei_levoy, efros_leung };
enum class PixelSearch { coherence, exact };

template <>
inline constexpr auto enum_names<PixelAlgorithm> =
    std::to_array<std::string_view>({"lefebvre_hoppe", "wei_levoy", "efros_leung"});
template <>
inline constexpr auto enum_names<PixelSearch> = std::to_array<std::string_view>({"coherence",
                                                                                 "exact"});

/// Non-parametric sampling: every pixel of the result is a pixel of the exemplar whose
/// neighbourhood there is like the pixel's own. Three orders in which pixels are chosen:
///
/// lefebvre_hoppe  Lefebvre & Hoppe 2005, "Parallel controllable texture synthesis". Coarse to
///   fine, all pixels at once: the sources of the level above are refined, displaced (jitter) and
///   corrected in sub-passes. Departures: the coarsest level starts from blocks that fit, not from
///   1×1 pixels and jitter (or regular structure is lost); a pyramid of twice the density in place
///   of the stack; 16 principal components of a Gaussian-weighted window, not 6; parallel over
///   threads with the same bytes for any number of them.
/// wei_levoy  Wei & Levoy 2000, "Fast texture synthesis using tree-structured vector quantization".
///   In scan order, by an L-shaped stencil and the whole neighbourhood in the level above.
///   Departures: finer levels start from the level above, not from noise; only axes that tile wrap
///   around, and pixels near their seams are chosen once more, by their whole neighbourhood.
/// efros_leung  Efros & Leung 1999, "Texture synthesis by non-parametric sampling". From a seed
///   outwards, pixels with most known neighbours first, one level, Gaussian weights. Departure:
///   the seed lies on the seam of axes that tile.
///
/// Searches: "exact" compares values at every pixel of the exemplar: about half a minute for 128²
/// from 128². "coherence" tries the sources that continue those of the 3×3 neighbours and the
/// pixels like them (k-coherence: Ashikhmin 2001; Tong et al. 2002), found once for each level by
/// random partitions of the principal components. Where none of them fits at all, wei_levoy and
/// efros_leung search in full. Neighbourhoods that leave the exemplar are used only where no others
/// are left (in lefebvre_hoppe's corrections the exemplar is mirrored there instead).
///
/// Several exemplars and masks: pixels come from usable ones alone, at every level; neighbourhoods
/// that reach beyond see the nearest usable pixel's values.
/// Guide (all algorithms): the difference of guides is added to that of neighbourhoods, half of it
/// the pixel's own and half that of means over the neighbourhood, in place of the full
/// neighbourhoods of Hertzmann, Jacobs, Oliver, Curless, Salesin 2001, "Image analogies";
/// lefebvre_hoppe also tries pixels drawn at random from those with the wanted guide. Weights of
/// exemplars are a guide.
/// Fill (not wei_levoy, whose pixels are chosen in scan order): known pixels keep their colours at
/// every level, and those within reach of a hole are given the sources that they are most like, so
/// that coherence continues them; holes start from blocks at a level where they are a few blocks
/// wide. efros_leung grows from what is known.
///
/// Exemplars of any size from 1×1 and of 1 to 64 channels; of more than 4, the 4 principal
/// components are compared.
struct PixelParams {
  static constexpr std::string_view kind = "pixel";
  static constexpr std::string_view summary =
      "pixels of the exemplar whose neighbourhoods fit (Lefebvre & Hoppe 2005; Wei & Levoy 2000; "
      "Efros & Leung 1999)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::guide,    Ability::mix,       Ability::fill,
                                       Ability::source};

  PixelAlgorithm algorithm = PixelAlgorithm::lefebvre_hoppe;
  PixelSearch search = PixelSearch::coherence;
  int radius = 3;
  int levels = 0;
  int candidates = 4;
  int passes = 4;
  double variety = 0.1;
  double jitter = 0.0;
  double tolerance = 0.1;

  static constexpr auto fields() {
    return std::tuple{
        Field{"algorithm", &PixelParams::algorithm, "in which order pixels are chosen"},
        Field{"search", &PixelParams::search,
              "which pixels of the exemplar are tried: those that continue a neighbour's source "
              "and ones like it, or all (slow)"},
        Field{"radius",
              &PixelParams::radius,
              "reach of the neighbourhood to each side",
              "pixels",
              {1, 15}},
        Field{"levels",
              &PixelParams::levels,
              "levels of the pyramid, 0: until the shorter side has 20 to 39 pixels (not "
              "efros_leung)",
              "",
              {0, 12}},
        Field{"candidates",
              &PixelParams::candidates,
              "like pixels remembered for each pixel of the exemplar, itself included",
              "",
              {1, 16}},
        Field{"passes",
              &PixelParams::passes,
              "corrections of every pixel at each level (lefebvre_hoppe)",
              "",
              {1, 100}},
        Field{"variety",
              &PixelParams::variety,
              "how strongly the coarsest level avoids places that it used before (lefebvre_hoppe)",
              "",
              {0, 10}},
        Field{"jitter",
              &PixelParams::jitter,
              "random displacement at each level (lefebvre_hoppe)",
              "pixels of the level",
              {0, 1}},
        Field{"tolerance",
              &PixelParams::tolerance,
              "relative error by which a pixel chosen at random may exceed the best (not "
              "lefebvre_hoppe)",
              "",
              {0, 10}}};
  }
};

/// The same bytes for any number of threads. Throws ConfigError for a parameter out of range, Error
/// for an exemplar that is empty, not finite or of more than 64 channels or a size without pixels,
/// Interrupted when `control` asks to stop.
Texture synthesise(const PixelParams& params, const Request& request, const Control& control);

/// Fitted to measurements: within a factor of 2 or so.
Cost estimate(const PixelParams& params, const RequestSize& request);

}  // namespace gramloom
