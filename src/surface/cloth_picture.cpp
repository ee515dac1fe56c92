#include "surface/cloth_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gramloom {

namespace {

// A point of the sheet over the picture: in pixels, from the first one's middle.
struct Corner {
  double x = 0, y = 0, height = 0;
};

// The corner as near to `other` as going around gets it.
Corner beside(Corner corner, const Corner& other, int width) {
  if (corner.x - other.x > 0.5 * width) corner.x -= width;
  if (other.x - corner.x > 0.5 * width) corner.x += width;
  return corner;
}

// Raises the pixels whose middles lie in a triangle to it.
void raise(Image& picture, const std::array<Corner, 3>& t) {
  const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (std::abs(area) < 1e-12) return;
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  const int first = std::max(0, static_cast<int>(std::ceil(top)));
  const int last = std::min(picture.height - 1, static_cast<int>(std::floor(bottom)));
  constexpr double slop = -1e-9;  // a pixel on an edge belongs to both sides
  for (int y = first; y <= last; ++y)
    for (int x = static_cast<int>(std::ceil(left)); x <= static_cast<int>(std::floor(right)); ++x) {
      const double b1 =
          ((x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y)) / area;
      const double b2 =
          ((t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y)) / area;
      if (b1 < slop || b2 < slop || b1 + b2 > 1 - slop) continue;
      const double height = (1 - b1 - b2) * t[0].height + b1 * t[1].height + b2 * t[2].height;
      float& pixel = *picture.at((x % picture.width + picture.width) % picture.width, y);
      pixel = std::max(pixel, static_cast<float>(height));
    }
}

}  // namespace

Image displacement_picture(const ClothSheet& sheet, const ArmAxis& axis, Size size, double bare) {
  std::vector<Corner> corners(sheet.count());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ArmPlace place =
        place_of(axis, {static_cast<double>(sheet.x[i]), static_cast<double>(sheet.y[i]),
                        static_cast<double>(sheet.z[i])});
    corners[i] = {place.around * size.width - 0.5,
                  (place.along / arm_length + 0.5) * size.height - 0.5, place.from - 1};
  }
  Image picture(size, 1, static_cast<float>(bare));
  for (int row = 0; row + 1 < sheet.rows; ++row)
    for (int column = 0; column < sheet.around; ++column) {
      const auto at = [&](int r, int c) {
        return corners[sheet.first(r) + static_cast<std::size_t>(c % sheet.around)];
      };
      const Corner a = at(row, column);
      const Corner b = beside(at(row, column + 1), a, size.width);
      const Corner c = beside(at(row + 1, column + 1), a, size.width);
      const Corner d = beside(at(row + 1, column), a, size.width);
      // Four triangles around the middle: the mirrored sheet has the mirrored picture.
      const Corner middle{0.25 * ((a.x + b.x) + (c.x + d.x)), 0.25 * ((a.y + b.y) + (c.y + d.y)),
                          0.25 * ((a.height + b.height) + (c.height + d.height))};
      raise(picture, {a, b, middle});
      raise(picture, {b, c, middle});
      raise(picture, {c, d, middle});
      raise(picture, {d, a, middle});
    }
  return picture;
}

}  // namespace gramloom
