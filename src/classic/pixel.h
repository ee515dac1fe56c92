#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"

namespace gramloom {

enum class PixelAlgorithm { lefebvre_hoppe, wei_levoy, efros_leung };
enum class PixelSearch { coherence, exact };

template <>
inline constexpr auto enum_names<PixelAlgorithm> =
    std::to_array<std::string_view>({"lefebvre_hoppe", "wei_levoy", "efros_leung"});
template <>
inline constexpr auto enum_names<PixelSearch> = std::to_array<std::string_view>({"coherence",
                                                                                 "exact"});

struct PixelParams {
  static constexpr std::string_view kind = "pixel";
  static constexpr std::string_view summary =
      "pixels of the exemplar whose neighbourhoods fit (Lefebvre & Hoppe 2005; Wei & Levoy 2000; "
      "Efros & Leung 1999)";

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
              "levels of the pyramid, 0: down to an exemplar of about 20 pixels (not efros_leung)",
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

Texture synthesise(const PixelParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control);

Cost estimate(const PixelParams& params, Size exemplar, int channels, const Target& target);

}  // namespace gramloom
