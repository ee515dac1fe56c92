#include "neural/picture.h"

namespace gramloom::neural {

at::Tensor to_planes(const Image& image) {
  const at::Tensor view = at::from_blob(const_cast<float*>(image.pixels.data()),
                                        {image.height, image.width, image.channels}, at::kFloat);
  return view.permute({2, 0, 1}).contiguous().clone();
}

Image to_image(const at::Tensor& planes) {
  const at::Tensor pixels = planes.permute({1, 2, 0}).contiguous();
  Image image(static_cast<int>(planes.size(2)), static_cast<int>(planes.size(1)),
              static_cast<int>(planes.size(0)));
  std::copy_n(pixels.data_ptr<float>(), image.pixels.size(), image.pixels.data());
  return image;
}

}  // namespace gramloom::neural
