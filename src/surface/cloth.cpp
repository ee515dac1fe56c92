#include "surface/cloth.h"

#include <algorithm>
#include <cmath>

#include "core/portable_math.h"
#include "surface/cloth_picture.h"

namespace gramloom {

namespace {

constexpr double degree = portable::pi / 180;
constexpr double overhang = 1.25;  // radii that the sleeve is longer at each end than what is seen

// The sleeve while the arm bends.
class Sleeve {
 public:
  explicit Sleeve(const ClothParams& params)
      : params_(params),
        cell_(arm_length / params.size.height),
        more_(static_cast<int>(std::ceil(overhang / cell_))),
        axis_(0),
        sheet_(params.size.width, params.size.height + 2 * more_),
        spacings_(spacings()) {
    for (int row = 0; row < sheet_.rows; ++row)
      for (int column = 0; column < sheet_.around; ++column)
        put(row, column,
            point_at(axis_, {(row + 0.5 - 0.5 * sheet_.rows) * cell_, around(column), 1}));
  }

  void step(const Pose& from, const Pose& to) {
    carry(from, to);
    for (int i = 0; i < params_.iterations; ++i) {
      relax(sheet_, spacings_, i % 2 == 1);
      keep_outside();
      hold_end(0, to.swing * degree);
      hold_end(sheet_.rows - 1, to.twist * degree);
    }
  }

  const ClothSheet& sheet() const { return sheet_; }
  const ArmAxis& axis() const { return axis_; }

 private:
  double around(int column) const { return (column + 0.5) / sheet_.around; }

  // How many make up a length: at least three, as two are always there.
  static int edges(double length, double edge) {
    return std::max(3, static_cast<int>(length / edge + 0.5));
  }

  std::vector<Spacing> spacings() const {
    const auto n = static_cast<double>(sheet_.around);
    const auto chord = [&](int cells) { return 2 * portable::sin(portable::pi * cells / n); };
    const auto length = [&](int down, int shift) {
      const double a = down * cell_, b = chord(std::abs(shift));
      return static_cast<float>(portable::sqrt(a * a + b * b));
    };
    const auto stretch = static_cast<float>(params_.stretch);
    const auto shear = static_cast<float>(params_.shear);
    const auto bending = static_cast<float>(params_.bending);
    // Those of one `down` move at once, and so each a half.
    const int down = edges(params_.fold, cell_), across = edges(params_.fold, chord(1));
    return {{down, 0, length(down, 0), bending},  {0, across, length(0, across), 0.5f * bending},
            {2, 0, length(2, 0), bending},        {0, 2, length(0, 2), 0.5f * bending},
            {1, 1, length(1, 1), 0.5f * shear},   {1, -1, length(1, -1), 0.5f * shear},
            {0, 1, length(0, 1), 0.5f * stretch}, {1, 0, length(1, 0), stretch}};
  }

  ArmPoint point(int row, int column) const {
    const std::size_t i = sheet_.first(row) + static_cast<std::size_t>(column);
    return {static_cast<double>(sheet_.x[i]), static_cast<double>(sheet_.y[i]),
            static_cast<double>(sheet_.z[i])};
  }
  void put(int row, int column, const ArmPoint& p) {
    const std::size_t i = sheet_.first(row) + static_cast<std::size_t>(column);
    sheet_.x[i] = static_cast<float>(p.x);
    sheet_.y[i] = static_cast<float>(p.y);
    sheet_.z[i] = static_cast<float>(p.z);
  }

  // Takes the cloth along with the arm, at its places on it.
  void carry(const Pose& from, const Pose& to) {
    const ArmAxis next(to.bend);
    const double half = 0.5 * arm_length + overhang;
    for (int row = 0; row < sheet_.rows; ++row)
      for (int column = 0; column < sheet_.around; ++column) {
        ArmPlace place = place_of(axis_, point(row, column));
        const double turn = place.along > 0 ? to.twist - from.twist : to.swing - from.swing;
        place.around += std::min(std::abs(place.along) / half, 1.0) * turn / 360;
        put(row, column, point_at(next, place));
      }
    axis_ = next;
  }

  // Points inside the arm come out of it the shortest way; none passes the bend's middle.
  void keep_outside() {
    const double arm = 1 - params_.slack, inside = 0.95 * axis_.reach();
    for (int row = 0; row < sheet_.rows; ++row)
      for (int column = 0; column < sheet_.around; ++column) {
        const ArmPoint p = point(row, column);
        const ArmAxis::Nearest near = axis_.nearest(p.y, p.z);
        const double from = portable::sqrt(p.x * p.x + near.inside * near.inside);
        if (from >= arm && near.inside <= inside) continue;
        const double out = from < arm ? arm / std::max(from, 1e-9) : 1;
        const double to = std::min(out * near.inside, inside);
        put(row, column,
            {out * p.x, near.frame.y + to * near.frame.inside_y,
             near.frame.z + to * near.frame.inside_z});
      }
  }

  // An end is a ring that goes along the arm as a whole, and turns with it.
  void hold_end(int row, double turn) {
    double along = 0;
    for (int column = 0; column < sheet_.around; ++column) {
      const ArmPoint p = point(row, column);
      along += axis_.along(p.y, p.z);
    }
    along /= sheet_.around;
    for (int column = 0; column < sheet_.around; ++column)
      put(row, column, point_at(axis_, {along, around(column) + turn / (2 * portable::pi), 1}));
  }

  const ClothParams& params_;
  double cell_;  // the length of an edge along the arm
  int more_;     // rows of the overhang
  ArmAxis axis_;
  ClothSheet sheet_;
  std::vector<Spacing> spacings_;
};

Sleeve bend(const ClothParams& params, const Pose& pose) {
  check_fields(params);
  check_fields(pose);
  Sleeve sleeve(params);
  Pose before;
  for (int i = 1; i <= params.steps; ++i) {
    const double share = static_cast<double>(i) / params.steps;
    const Pose now{pose.bend * share, pose.twist * share, pose.swing * share};
    sleeve.step(before, now);
    before = now;
  }
  return sleeve;
}

}  // namespace

ClothSheet bent_sleeve(const ClothParams& params, const Pose& pose) {
  return bend(params, pose).sheet();
}

Image sleeve_displacement(const ClothParams& params, const Pose& pose) {
  const Sleeve sleeve = bend(params, pose);
  return displacement_picture(sleeve.sheet(), sleeve.axis(), params.size, -params.slack);
}

}  // namespace gramloom
