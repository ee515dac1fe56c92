#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "classic/quilt_direction.h"
#include "core/image.h"
#include "core/random.h"
#include "core/request.h"
#include "signal/patch_origin.h"

namespace gramloom {

/// Buffers that patches laid at the same time borrow and give back, so that there are only as many
/// as threads.
class Buffers {
 public:
  std::vector<float> borrow() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return {};
    std::vector<float> buffer = std::move(free_.back());
    free_.pop_back();
    return buffer;
  }
  void give_back(std::vector<float> buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<float>> free_;
};

/// The least of the errors, and its index; of equal ones the first.
struct LeastError {
  float error = 0;
  std::size_t index = 0;
};
LeastError least_error(const std::vector<float>& errors);

/// One of the positions whose error is at most `limit`, all equally likely; there is one. `width`
/// positions a row.
PatchOrigin draw_up_to(const std::vector<float>& errors, int width, float limit, Random& random);

/// Adds what the direction of a quilt says to errors of overlaps.
struct DirectedErrors {
  float least = 0;
  float own = 0;  // what of the least one isn't the guide's; all of it where nothing overlaps
};
struct OverlapScale {
  float scale = 0;               // the error of unrelated patches, halved; where nothing overlaps,
                                 // of whole ones
  std::vector<float> made = {};  // as QuiltDirection::add_to()'s
  bool overlaps = true;
};
DirectedErrors add_direction(const QuiltDirection& direction, PatchOrigin place,
                             const OverlapScale& overlap, std::vector<float>& errors,
                             Buffers& buffers);

/// Lays a patch at `place` of the canvas: `weights` of fresh pixels, 1 − these of old ones. Sources
/// are those of which there is more.
void lay_pixels(const Image& old, const Image& fresh, PatchOrigin origin,
                const std::vector<float>& weights, PatchOrigin place, Image& canvas,
                SourceMap& source);

}  // namespace gramloom
