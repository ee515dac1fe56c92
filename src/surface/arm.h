#pragma once

namespace gramloom {

/// A tube around an axis that bends at its middle, the elbow: a stretch of an arc between two
/// straight halves. Lengths are in radii of the tube. The axis stands upright (y) when it is
/// straight; bent, both halves turn alike towards the viewer (z).
///
/// A place on the tube or near it has three coordinates: how far it is along the axis, from
/// −arm_length / 2 at the upper end to arm_length / 2; around it, in [0, 1), 0 on the outside of
/// the elbow, ¼ at −x and ½ on the inside; and from it, which is 1 on the tube itself.
struct ArmPlace {
  double along = 0, around = 0, from = 1;
};
inline constexpr double arm_length = 8;
inline constexpr double arm_elbow = 3;  // of it, what bends

/// The axis of such a tube.
class ArmAxis {
 public:
  /// `bend` in degrees, at most 150: more than that would not leave the elbow's inside any room.
  explicit ArmAxis(double bend);

  /// A point of the axis, the axis's direction there and that of the bend's inside, at right angles
  /// to it. All three have x = 0.
  struct Frame {
    double y, z, along_y, along_z, inside_y, inside_z;
  };
  Frame frame(double along) const;
  /// The axis's point nearest to one with these y and z, whatever its x, and how far the latter
  /// lies from there towards the inside.
  struct Nearest {
    Frame frame;
    double inside;
  };
  Nearest nearest(double y, double z) const;
  /// How far along the axis that is.
  double along(double y, double z) const;
  /// How far inside of the axis is the point that it is bent around, beyond which places are not
  /// told apart. Infinite for a straight arm.
  double reach() const { return radius_; }

 private:
  bool is_straight() const { return bend_ == 0; }
  double way_beyond_arc(double y, double z) const;

  double bend_;           // radians
  double radius_;         // of the arc
  double sine_, cosine_;  // of half the bend
  double end_y_, end_z_;  // of the arc, on the lower half
};

struct ArmPoint {
  double x, y, z;
};
/// The point at a place, and the reverse.
ArmPoint point_at(const ArmAxis& axis, const ArmPlace& place);
ArmPlace place_of(const ArmAxis& axis, const ArmPoint& point);

}  // namespace gramloom
