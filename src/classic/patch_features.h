#pragma once

#include "core/image.h"
#include "signal/colour_pca.h"

namespace gramloom {

/// The 4 features of each pixel that patches are compared by, each with mean 0: the channels' first
/// three principal components, scaled to a total variance of 1, and structure, of variance
/// `structure`²: how much those differ from their means over 9×9 pixels. It stands for the guidance
/// channel of Kaspar et al. 2015 (distance to edges, section 4): on coarse levels it still tells
/// where fine lines are, such as joints between tiles.
Image patch_features(const Image& image, double structure);

/// What the features of one image were taken by, so that another's can be compared with them.
struct FeatureAxes {
  ColourPca pca;
  double scale = 0;
  double structure_mean = 0, structure_scale = 0;
};

/// The same of an image of which only pixels whose mask is 1 count (an empty mask: all): means over
/// 9×9 pixels, and those of structure, are over them alone. `axes` becomes what they are taken by.
Image patch_features(const Image& image, const Image& mask, double structure, FeatureAxes& axes);
/// Those of another image, taken by the same axes.
Image patch_features(const Image& image, const Image& mask, const FeatureAxes& axes);

/// Half the size (rounded down), each pixel the mean of 2×2, so that pixel (x, y) of the half lies
/// over pixels (2x, 2y) to (2x + 1, 2y + 1).
Image halved(const Image& image);

}  // namespace gramloom
