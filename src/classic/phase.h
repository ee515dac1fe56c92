#pragma once

#include <string_view>
#include <tuple>

#include "core/abilities.h"
#include "core/cost.h"
#include "core/fields.h"
#include "core/progress.h"
#include "core/request.h"
#include "signal/random_phase.h"

namespace gramloom {

/// Random phase noise: the exemplar's spectrum with random phases, the same ones added to each
/// channel so that colours stay together. Galerne, Gousseau, Morel 2011, "Random phase textures:
/// theory and synthesis", IEEE Transactions on Image Processing 20(1), section V; also IPOL 2011,
/// "Micro-texture synthesis by phase randomization". Grain, cloth and water come out right, shapes
/// dissolve. The periodic component is taken first (Moisan 2011), so edges leave no cross.
///
/// Larger results: the exemplar less its mean, faded out at its border and in the middle of zeros,
/// is the spot whose phases are randomised (IPOL, algorithm 2).
/// Departures: the border fades by a raised cosine in place of the paper's integral of a bump,
/// which differs by less than the random phases do. A tile smaller than the exemplar, which the
/// paper does not treat, wraps the spot around: its covariance is the exemplar's, wrapped likewise.
/// The result, which is close to Gaussian, is clamped to the exemplar's range.
///
/// Masked exemplars: the spot is their usable pixels alone, less their mean, among zeros and
/// normalised by their number (the discrete spot of Galerne, Leclaire, Moisan 2017, "Texton noise",
/// section 2); no periodic component is taken, and nothing fades.
/// Several exemplars: each has noise of its own, and these are added times the roots of their
/// shares, so that mean and covariance are the weighted ones, constant or from place to place (not
/// the barycentre of Xia, Ferradans, Peyré, Aujol 2014, which needs one phase for all). Without
/// weights the shares are those of usable pixels.
struct PhaseParams {
  static constexpr std::string_view kind = "phase";
  static constexpr std::string_view summary =
      "the exemplar's spectrum with random phases (grain without structure)";
  static constexpr Abilities abilities{Ability::exemplar, Ability::exemplars, Ability::mask,
                                       Ability::mix};
  double fade = usual_fade;
  static constexpr auto fields() {
    return std::tuple{
        Field{"fade",
              &PhaseParams::fade,
              "width of the exemplar's border that fades out where the result is larger",
              "share of the side",
              {0, 0.5}}};
  }
};

/// Throws Error for input that check_request() refuses.
Texture synthesise(const PhaseParams& params, const Request& request, const Control& control);
Cost estimate(const PhaseParams& params, const RequestSize& request);

}  // namespace gramloom
