#pragma once

#include <vector>

#include "core/request.h"

namespace gramloom {

/// Colours as a generator sees them: P = to_axes · (colour − mean), colour = mean + axes · P.
/// Along the principal axes of all exemplars together, each layer by itself, the deviation d
/// becomes (d / d₁)^(1 − whitening), with d₁ the layer's largest: strong axes count more, and
/// layers alike.
struct ColourAxes {
  int channels = 0;
  std::vector<float> mean;
  std::vector<float> to_axes, axes;  // channels × channels
};
ColourAxes colour_axes(const std::vector<Image>& exemplars, const std::vector<Layer>& layers,
                       double whitening);

}  // namespace gramloom
