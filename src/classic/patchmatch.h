#pragma once

#include <string_view>
#include <tuple>

#include "core/fields.h"
#include "core/image.h"
#include "core/progress.h"
#include "core/random.h"

namespace gramloom {

struct PatchmatchParams {
  static constexpr std::string_view kind = "patchmatch";
  static constexpr std::string_view summary =
      "all overlapping patches optimised together, coarse to fine (Kwatra et al. 2005, Barnes et "
      "al. 2009, Kaspar et al. 2015)";

  int levels = 0;
  int iterations = 12;
  int tries = 4;
  double uniformity = 0.1;
  int start_patch = 12;
  bool sharp = true;

  static constexpr auto fields() {
    using P = PatchmatchParams;
    return std::tuple{
        Field{"levels", &P::levels, "levels of the pyramid; 0: as many as suit the exemplar", "",
              {0, 12}},
        Field{"iterations", &P::iterations, "on the finest level", "", {1, 1000}},
        Field{"tries", &P::tries, "random candidates", "", {0, 100}},
        Field{"uniformity", &P::uniformity, "", "", {0, 100}},
        Field{"start_patch", &P::start_patch, "", "", {0, 100}},
        Field{"sharp", &P::sharp, ""},
    };
  }
};

/// The texture. Throws Error for an empty exemplar or target, Interrupted when `control` asks to
/// stop.
Texture synthesise(const PatchmatchParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control);

/// Peak memory and time of that synthesis.
Cost estimate(const PatchmatchParams& params, Size exemplar, int channels, const Target& target);

}  // namespace gramloom
