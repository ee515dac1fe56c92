#pragma once

#include <ATen/ATen.h>

#include <optional>

#include "core/request.h"
#include "signal/colour_pca.h"
#include "signal/united.h"

namespace gramloom::neural {

/// What a request says beyond one exemplar that may all be used, and a size: masks, several
/// exemplars, known pixels, a guide, weights. Pictures of the exemplars have the size of the joined
/// one (signal/united.h), those of the result the canvas's (settings.h), or a level's.
struct Guidance {
  Image usable;  // of the exemplar: 1 may be used, 0 may not; empty: all may
  Image member;  // likewise: a channel for each exemplar that is mixed, 1 where it is; empty: none
  Image shares;  // of the result: how much of each of them, their sum is 1; empty: none
  Image made;    // likewise: 1 is made, 0 is known; empty: all is made
  at::Tensor known;  // (channels, height, width): what stays where `made` is not 1; in holes the
                     // nearest known pixel's
  int channels = 0;  // of the picture
  Image exemplar_guide, guide;  // of the same channels; empty: none
  Image guide_weight;           // of the result, like `guide`
  Tile tile = Tile::none;       // of the result
  bool whole = true;            // whether the exemplar is one picture, not several

  bool fills() const { return !made.empty(); }
  bool guides() const { return !guide.empty(); }
  bool mixes() const { return !shares.empty(); }
  /// Whether the result is not the same everywhere, or is not to be like the exemplar as a whole.
  bool directs() const { return fills() || guides() || mixes(); }
};

/// Of the finest level; nothing for a request that says no such thing. `united` is of that request;
/// colours are those that the loss sees.
std::optional<Guidance> guidance_of(const Request& request, const United& united, Size canvas,
                                    const ColourPca& colours);

/// The same for an exemplar and a result of these sizes. A pixel may be used, or is known, where
/// all pixels are that lie under it.
Guidance scaled(const Guidance& finest, Size exemplar, Size result);

/// The same with weights as a guide, too: shares of the exemplars are to be like which one a patch
/// is of. For layouts, whose patches are of one exemplar or the other.
Guidance with_shares_as_guide(Guidance guidance);

/// The mask of what may be used at that size.
Image scaled_mask(const Image& mask, Size size);

/// A picture's pixels that are not made become the known ones, times `factor`.
void keep_known(const Guidance& guidance, at::Tensor& picture, double factor = 1);

/// The pixels of `image` that may be used, as one row.
Image usable_pixels(const Image& image, const Image& mask);

/// From each pixel that is made the steps to the nearest that is not, as a king goes; 0 elsewhere.
/// The largest is half the width of the widest hole.
std::vector<int> steps_to_known(const Image& made);

}  // namespace gramloom::neural
