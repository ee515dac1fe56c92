#pragma once

#include <vector>

namespace gramloom {

/// The points of a tube of cloth: `rows` rings of `around` points.
struct ClothSheet {
  int around = 0, rows = 0;
  std::vector<float> x, y, z;  // of ring after ring

  ClothSheet(int around_, int rows_)
      : around(around_), rows(rows_), x(count()), y(count()), z(count()) {}
  std::size_t count() const {
    return static_cast<std::size_t>(around) * static_cast<std::size_t>(rows);
  }
  std::size_t first(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(around);
  }
};

/// That each point of a ring and the one `shift` further in the ring `down` below it are `rest`
/// apart; of what they are not, they move `stiffness` towards each other, each a half (Müller,
/// Heidelberger, Hennix, Ratcliff 2007, "Position based dynamics", 3.3).
struct Spacing {
  int down = 0, shift = 0;
  float rest = 0, stiffness = 1;
};

/// Brings the spacings of all rings nearer to their rest: ring after ring, downwards or upwards.
/// Spacings with the same `down` are done at once in a ring, each seeing where its points were: so
/// a sheet that is its own mirror image stays one, and a ring is a loop without branches.
void relax(ClothSheet& sheet, const std::vector<Spacing>& spacings, bool upwards);

}  // namespace gramloom
