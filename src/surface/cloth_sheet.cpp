#include "surface/cloth_sheet.h"

#include <algorithm>
#include <cmath>

namespace gramloom {

namespace {

// What points move, one a point of a ring.
struct Moves {
  std::vector<float> x, y, z;

  explicit Moves(int around) : x(static_cast<std::size_t>(around)), y(x.size()), z(x.size()) {}
};

struct Points {
  float *x, *y, *z;
};
Points points(ClothSheet& sheet, int row, int column) {
  const std::size_t at = sheet.first(row) + static_cast<std::size_t>(column);
  return {sheet.x.data() + at, sheet.y.data() + at, sheet.z.data() + at};
}

// Moves of `count` points a towards as many points b.
void measure(const Points& a, const Points& b, int count, const Spacing& spacing, float* mx,
             float* my, float* mz) {
  constexpr float least = 1e-6f;  // no direction is left in a shorter one
  const float half = 0.5f * spacing.stiffness;
  for (int i = 0; i < count; ++i) {
    const float dx = b.x[i] - a.x[i], dy = b.y[i] - a.y[i], dz = b.z[i] - a.z[i];
    const float length = std::max(std::sqrt(dx * dx + dy * dy + dz * dz), least);
    const float share = half * (1 - spacing.rest / length);
    mx[i] = share * dx;
    my[i] = share * dy;
    mz[i] = share * dz;
  }
}

void add(const Points& points, const Moves& moves, int from, int count, float sign) {
  for (int i = 0; i < count; ++i) {
    points.x[i] += sign * moves.x[static_cast<std::size_t>(from + i)];
    points.y[i] += sign * moves.y[static_cast<std::size_t>(from + i)];
    points.z[i] += sign * moves.z[static_cast<std::size_t>(from + i)];
  }
}

// The two runs of a ring whose partners, `shift` further, do not wrap in between.
template <class Run>
void in_runs(int around, int shift, Run&& run) {
  const int turned = (shift % around + around) % around;
  run(0, turned, around - turned);
  if (turned > 0) run(around - turned, 0, turned);
}

void relax_ring(ClothSheet& sheet, int row, const std::vector<Spacing>& spacings, std::size_t first,
                std::size_t last, std::vector<Moves>& moves) {
  const int below = row + spacings[first].down;
  for (std::size_t s = first; s < last; ++s)
    in_runs(sheet.around, spacings[s].shift, [&](int from, int to, int count) {
      Moves& m = moves[s];
      measure(points(sheet, row, from), points(sheet, below, to), count, spacings[s],
              m.x.data() + from, m.y.data() + from, m.z.data() + from);
    });
  for (std::size_t s = first; s < last; ++s) {
    add(points(sheet, row, 0), moves[s], 0, sheet.around, 1);
    in_runs(sheet.around, spacings[s].shift, [&](int from, int to, int count) {
      add(points(sheet, below, to), moves[s], from, count, -1);
    });
  }
}

}  // namespace

void relax(ClothSheet& sheet, const std::vector<Spacing>& spacings, bool upwards) {
  std::vector<Moves> moves(spacings.size(), Moves(sheet.around));
  for (int i = 0; i < sheet.rows; ++i) {
    const int row = upwards ? sheet.rows - 1 - i : i;
    for (std::size_t first = 0, last = 0; first < spacings.size(); first = last) {
      while (last < spacings.size() && spacings[last].down == spacings[first].down) ++last;
      if (row + spacings[first].down < sheet.rows)
        relax_ring(sheet, row, spacings, first, last, moves);
    }
  }
}

}  // namespace gramloom
