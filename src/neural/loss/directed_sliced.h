#pragma once

#include <memory>

#include "neural/loss/loss_term.h"
#include "neural/loss/sliced.h"

namespace gramloom::neural {

/// The sliced Wasserstein distance (sliced.h) of a request that says more than one whole exemplar:
/// between patches of the result that count, and patches that lie in usable pixels alone.
///   Guide: each patch of the result is compared with one drawn anew in each step from where the
///     exemplar's guide is like its own (guide_draws.h), so that both sides have the guides of the
///     result; and both have them as further coordinates, so that what is alike in the guide is
///     matched with each other (Heitz, Vanhoey, Chambon, Belcour 2021, section 4.3: spatial tags).
///   Fill: with those that it is most like at the level's beginning (directed_places.h).
///   Weights: the goal is the barycentre of the exemplars' sets: along each direction quantiles are
///     averaged (Rabin, Peyré, Delon, Bernot 2011, "Wasserstein barycenter and its application to
///     texture mixing"); of a picture of weights, for patches of nearly equal ones together, in
///     steps of an eighth, about which they are strewn.
/// More than SlicedParams::positions patches are a random part in each step, and only that part has
/// a gradient.
std::unique_ptr<PictureTerm> make_directed_sliced(const SlicedParams& params,
                                                  const LossInput& input);

}  // namespace gramloom::neural
