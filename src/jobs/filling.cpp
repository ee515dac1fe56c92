#include "jobs/filling.h"

#include <algorithm>

namespace gramloom {

namespace {

constexpr int widest_band = 64;  // of edges that are made anew where the config does not say

// `image` in the middle of a larger one, at (left, top).
Image placed(const Image& image, int left, int top, Size size, float around) {
  if (image.size() == size) return image;
  Image result(size, image.channels, around);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.at(0, y), static_cast<std::size_t>(image.width * image.channels),
                result.at(left, top + y));
  return result;
}

int band_of(const FillEntry& fill, int length) {
  return fill.band > 0 ? fill.band : std::min(widest_band, std::max(1, length / 8));
}

// Marks the edges that are to meet.
void mark_bands(const FillEntry& fill, Image& mask) {
  const int columns = tiles_x(fill.seamless) ? band_of(fill, mask.width) : 0;
  const int rows = tiles_y(fill.seamless) ? band_of(fill, mask.height) : 0;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (x < columns || x >= mask.width - columns || y < rows || y >= mask.height - rows)
        *mask.at(x, y) = 1;
}

// 1 where the picture is to be made anew.
Image hole_of(const FillEntry& fill, const PictureFiles& picture, const std::string& place) {
  Image hole(picture.images.front().size(), 1, 0.0f);
  if (fill.mask.empty()) return hole;
  hole = read_mask(fill.mask, picture, "the mask of [fill]", place);
  if (fill.mask.is_name())  // where it is transparent, not where it is opaque
    for (float& value : hole.pixels) value = 1 - value;
  return hole;
}

std::string described(const FillEntry& fill) {
  return fill.mask.empty() || fill.mask.is_name()
             ? fill.image.string()
             : fmt::format("{} with {}", fill.image.string(), fill.mask.string());
}

void check_hole(const FillEntry& fill, const Image& mask, bool from_itself,
                const std::string& place) {
  const auto made = std::ranges::count(mask.pixels, 1.0f);
  if (made == 0)
    throw ConfigError("{}: there is nothing to be made anew in {}: the mask is black everywhere",
                      place, described(fill));
  if (from_itself && made == static_cast<std::ptrdiff_t>(mask.pixels.size()))
    throw ConfigError(
        "{}: all of {} is to be made anew, and nothing is left to make it of: the mask is white "
        "everywhere, or the band as wide as the picture ({}×{}), and there is no [[exemplar]]",
        place, described(fill), mask.width, mask.height);
}

}  // namespace

Corner corner_of(const FillEntry& fill) {
  return fill.extend.empty() ? Corner{} : Corner{fill.extend[0], fill.extend[1]};
}

Filling filling_of(const FillEntry& fill, PictureFiles picture, Size size, bool from_itself,
                   const std::string& place) {
  Filling filling;
  Image hole = hole_of(fill, picture, place);
  const auto [left, top] = corner_of(fill);
  filling.mask = placed(hole, left, top, size, 1);
  mark_bands(fill, filling.mask);
  check_hole(fill, filling.mask, from_itself, place);
  filling.usable = std::move(hole);
  for (int y = 0; y < filling.usable.height; ++y)
    for (int x = 0; x < filling.usable.width; ++x)
      *filling.usable.at(x, y) = 1 - *filling.mask.at(left + x, top + y);
  filling.known = placed(joined(std::move(picture)), left, top, size, 0);
  return filling;
}

}  // namespace gramloom
