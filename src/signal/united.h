#pragma once

#include <vector>

#include "core/request.h"

namespace gramloom {

/// The exemplars of a request as one picture, for methods that look for places in one: side by
/// side, each with what follows it masked. Weights of exemplars (Target::weights) become a guide
/// that tells the exemplars apart. Several exemplars, masks and weights are then nothing but a mask
/// and a guide.
///
/// Pixels that may not be used hold the values of the nearest one that may, so that statistics of
/// neighbourhoods see nothing foreign. One exemplar without a mask is taken as it is, not copied:
/// then the request must outlive this.
class United {
 public:
  explicit United(const Request& request);

  /// Its mask is empty where all may be used; its guide has the weights' channels last.
  const Exemplar& exemplar() const { return joined_.image.empty() ? *one_ : joined_; }
  /// What the target asks of that guide, of the target's size; empty: nothing.
  const Image& guide() const { return guide_.empty() ? *target_guide_ : guide_; }

  /// Which exemplar's pixel (x, y) of the joined picture is.
  Source source(int x, int y) const;
  /// Brings sources in the joined picture to the exemplars that they are of.
  void name_sources(SourceMap& sources) const;

 private:
  const Exemplar* one_ = nullptr;
  const Image* target_guide_ = nullptr;
  Exemplar joined_;
  Image guide_;
  std::vector<int> left_;  // of each exemplar in the joined picture
};

/// `image` with pixels whose mask is 0 replaced by the nearest one whose mask is 1 (at least one).
Image extended(const Image& image, const Image& mask);

/// Which patches of this size lie in usable pixels alone, row by row; an empty mask: all do. Of an
/// image smaller than a patch: none.
std::vector<unsigned char> usable_origins(const Image& mask, Size image, Size patch);

/// `mask` in half the size, as halved() pictures are: a pixel may be used where all of its four
/// may.
Image halved_mask(const Image& mask);

/// The map's values at (x, y), of one that is of the target's size or of 1×1.
inline const float* map_at(const Image& map, int x, int y) {
  return map.size() == Size{1, 1} ? map.pixels.data() : map.at(x, y);
}

}  // namespace gramloom
