#include "neural/made_pixels.h"

#include <algorithm>

namespace gramloom::neural {

MadePixels::MadePixels(const Guidance& guidance) {
  if (!guidance.fills()) return;
  std::vector<std::int64_t> places;
  for (std::size_t i = 0; i < guidance.made.pixels.size(); ++i)
    if (guidance.made.pixels[i] > 0) places.push_back(static_cast<std::int64_t>(i));
  places_ = at::tensor(places, at::kLong);
}

at::Tensor MadePixels::take(const at::Tensor& picture) const {
  return picture.view({picture.size(0), -1}).index_select(1, places_);
}

void MadePixels::put(const at::Tensor& pixels, at::Tensor& picture) const {
  picture.view({picture.size(0), -1}).index_copy_(1, places_, pixels);
}

void copy_known(const Target& target, Image& image) {
  if (target.known.empty()) return;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (*target.mask.at(x, y) <= 0.5f)
        std::copy_n(target.known.at(x, y), image.channels, image.at(x, y));
}

}  // namespace gramloom::neural
