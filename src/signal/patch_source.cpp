#include "signal/patch_source.h"

#include <algorithm>

namespace gramloom {

Size patch_origins(Size image) {
  return {image.width - field_patch + 1, image.height - field_patch + 1};
}

void prepare(PatchSource& source) {
  source.scale = sketch_scale(source.features);
  source.sketches = sketch_patches(source.features, source.scale);
}

std::vector<Image> guide_planes(const Image& guide) {
  std::vector<Image> planes;
  for (int first = 0; first < guide.channels; first += field_features) {
    const int count = std::min(field_features, guide.channels - first);
    Image& plane = planes.emplace_back(guide.size(), field_features);
    for (int y = 0; y < guide.height; ++y)
      for (int x = 0; x < guide.width; ++x)
        std::copy_n(guide.at(x, y) + first, count, plane.at(x, y));
  }
  return planes;
}

}  // namespace gramloom
