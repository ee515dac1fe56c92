#pragma once

#include <vector>

#include "neural/flow/band_match.h"
#include "neural/flow/guided_patches.h"
#include "neural/flow/prices.h"
#include "neural/flow/vote.h"
#include "neural/guidance.h"
#include "neural/guide_draws.h"

namespace gramloom::neural {

/// What guidance says to patch flow matching on one octave, for patches of one size.
class OctaveGuidance {
 public:
  /// exemplar, picture: their sizes on the octave. Weights of exemplars are a guide here. Throws
  /// Error where no patch of the exemplar may be used.
  OctaveGuidance(const Guidance& finest, Size exemplar, Size picture, int side);

  const Guidance& guidance() const { return guidance_; }
  bool fills() const { return guidance_.fills(); }
  bool guides() const { return guidance_.guides(); }

  /// Patches of the exemplar in usable pixels alone.
  const std::vector<PatchPlace>& usable() const { return usable_; }
  bool is_usable(PatchPlace place) const;

  /// Of a fill: those patches of the picture that begin on every other pixel, from `shift_x` and
  /// `shift_y` on, or lie at an edge, and have a pixel that is made.
  std::vector<PatchPlace> queries(int shift_x, int shift_y) const;
  /// Weights (queries × neighbours) of a fill's votes become the smaller, the farther a patch's
  /// middle is from known pixels: what is sure comes first (Wexler, Shechtman, Irani 2007,
  /// "Space-time completion of video", section 3.2).
  void add_confidence(const std::vector<PatchPlace>& queries, std::vector<float>& weights) const;

  const GuidedPatches& guided() const { return guided_; }
  /// How much pixels count in a vote: the less, the less the exemplar's guide is like that of the
  /// place. Nothing where each counts alike.
  Agreement agreement() const;
  /// The mean price of places of about one guide becomes 0: prices balance among those alone.
  void level(Prices prices) const;

  /// Where bands of the picture are to be those of the exemplar: where guides are alike, usable and
  /// made.
  const Regions& regions() const { return regions_; }
  const Regions& exemplar_regions() const { return exemplar_regions_; }

 private:
  void find_regions(Size exemplar, Size picture);

  Guidance guidance_;
  int side_;
  Size places_, picture_;
  std::vector<PatchPlace> usable_;
  std::vector<unsigned char> is_usable_;  // of all places
  GuidedPatches guided_;
  GuideGroups like_guides_;            // of usable_
  std::vector<unsigned char> counts_;  // of a fill: whether a patch of the picture has a made pixel
  std::vector<float> confidence_;      // likewise: what it counts
  Regions exemplar_regions_, regions_;
};

}  // namespace gramloom::neural
