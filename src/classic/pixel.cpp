#include "classic/pixel.h"

#include <algorithm>
#include <cmath>

#include "classic/pixel_algorithms.h"

namespace gramloom {
namespace {

void check(const Image& exemplar, const Target& target) {
  if (exemplar.empty()) throw Error("pixel: the exemplar is empty");
  if (exemplar.channels > 64)
    throw Error("pixel: the exemplar has {} channels; at most 64 are allowed", exemplar.channels);
  if (!std::all_of(exemplar.pixels.begin(), exemplar.pixels.end(),
                   [](float value) { return std::isfinite(value); }))
    throw Error("pixel: the exemplar has values that are not finite");
  if (target.size.width < 1 || target.size.height < 1)
    throw Error("pixel: the size {} × {} has no pixels", target.size.width, target.size.height);
}

pixel::Canvas sources(const PixelParams& params, const Image& exemplar, const Target& target,
                      Random random, const Control& control) {
  switch (params.algorithm) {
    case PixelAlgorithm::efros_leung:
      return pixel::efros_leung(params, exemplar, target, random, control);
    case PixelAlgorithm::wei_levoy:
      return pixel::wei_levoy(params, exemplar, target, random, control);
    case PixelAlgorithm::lefebvre_hoppe:
      break;
  }
  return pixel::lefebvre_hoppe(params, exemplar, target, random, control);
}

}  // namespace

Texture synthesise(const PixelParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_fields(params);
  check(exemplar, target);
  return {pixel::colours_of(sources(params, exemplar, target, random, control), exemplar), {}};
}

}  // namespace gramloom
