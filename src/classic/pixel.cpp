#include "classic/pixel.h"

#include "classic/pixel_algorithms.h"

namespace gramloom {

Texture synthesise(const PixelParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_fields(params);
  const auto canvas = pixel::lefebvre_hoppe(params, exemplar, target, random, control);
  return {pixel::colours_of(canvas, exemplar), {}};
}

}  // namespace gramloom
