#pragma once

#include <vector>

#include "core/request.h"

namespace gramloom {

/// A request with a turn (Target::turn) as one without: the exemplars become copies of themselves,
/// each turned and scaled as some part of the target asks, with masks where a copy has no pixels,
/// and a guide says which copy belongs where. So every method that takes several exemplars, masks
/// and a guide can lay wood round a corner. Turns are rounded to 15°, scales to a quarter of an
/// octave, or more coarsely where copies, side by side, would have more than `most_pixels`.
///
/// Values are interpolated (cubic, clamped to the exemplar's range), and normals turn with their
/// picture.
class Turned {
 public:
  static constexpr double most_pixels = 24e6;

  /// Throws Error for a request whose exemplars are too large for two copies.
  explicit Turned(const Request& request);

  const Request& request() const { return request_; }
  /// From pixels of the copies to the exemplars' nearest ones.
  void name_sources(SourceMap& sources) const;

 private:
  struct Copy {
    std::size_t exemplar;
    double back[6];  // from its pixels to the exemplar's: x' = b0 x + b1 y + b2, y' = b3 x + …
  };
  Copy add_copy(const Exemplar& exemplar, std::size_t number, double turn, double scale);

  Request request_;
  std::vector<Copy> copies_;
  std::vector<Size> sizes_;  // of the exemplars
};

/// What the request without a turn asks at most.
RequestSize size_of_turned(const RequestSize& request);

}  // namespace gramloom
