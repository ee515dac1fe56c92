#include "io/without_alpha.h"

#include <utility>

namespace gramloom {

Image without_alpha(ImageFile picture) {
  const std::vector<std::string>& names = picture.encoding.channel_names;
  if (picture.image.channels < 2 || names.empty() || names.back() != "A")
    return std::move(picture.image);
  return extract_channels(picture.image, 0, picture.image.channels - 1);
}

}  // namespace gramloom
