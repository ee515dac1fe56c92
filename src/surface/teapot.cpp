#include <array>

#include "surface/shapes.h"

namespace gramloom {

namespace {

// M. Newell's teapot of 1975: control points of a quarter of the pot and of halves of its handle
// and spout, in 100,000ths of a unit; the other parts are mirrored. Seen from above, x leads to the
// spout and z is height.
constexpr int control_points[][3]{
    {20000, 0, 270000},
    {20000, -11200, 270000},
    {11200, -20000, 270000},
    {0, -20000, 270000},
    {133750, 0, 253125},
    {133750, -74900, 253125},
    {74900, -133750, 253125},
    {0, -133750, 253125},
    {143750, 0, 253125},
    {143750, -80500, 253125},
    {80500, -143750, 253125},
    {0, -143750, 253125},
    {150000, 0, 240000},
    {150000, -84000, 240000},
    {84000, -150000, 240000},
    {0, -150000, 240000},
    {175000, 0, 187500},
    {175000, -98000, 187500},
    {98000, -175000, 187500},
    {0, -175000, 187500},
    {200000, 0, 135000},
    {200000, -112000, 135000},
    {112000, -200000, 135000},
    {0, -200000, 135000},
    {200000, 0, 90000},
    {200000, -112000, 90000},
    {112000, -200000, 90000},
    {0, -200000, 90000},
    {-200000, 0, 90000},
    {200000, 0, 45000},
    {200000, -112000, 45000},
    {112000, -200000, 45000},
    {0, -200000, 45000},
    {150000, 0, 22500},
    {150000, -84000, 22500},
    {84000, -150000, 22500},
    {0, -150000, 22500},
    {150000, 0, 15000},
    {150000, -84000, 15000},
    {84000, -150000, 15000},
    {0, -150000, 15000},
    {-160000, 0, 202500},
    {-160000, -30000, 202500},
    {-150000, -30000, 225000},
    {-150000, 0, 225000},
    {-230000, 0, 202500},
    {-230000, -30000, 202500},
    {-250000, -30000, 225000},
    {-250000, 0, 225000},
    {-270000, 0, 202500},
    {-270000, -30000, 202500},
    {-300000, -30000, 225000},
    {-300000, 0, 225000},
    {-270000, 0, 180000},
    {-270000, -30000, 180000},
    {-300000, -30000, 180000},
    {-300000, 0, 180000},
    {-270000, 0, 157500},
    {-270000, -30000, 157500},
    {-300000, -30000, 135000},
    {-300000, 0, 135000},
    {-250000, 0, 112500},
    {-250000, -30000, 112500},
    {-265000, -30000, 93750},
    {-265000, 0, 93750},
    {-200000, -30000, 90000},
    {-190000, -30000, 60000},
    {-190000, 0, 60000},
    {170000, 0, 142500},
    {170000, -66000, 142500},
    {170000, -66000, 60000},
    {170000, 0, 60000},
    {260000, 0, 142500},
    {260000, -66000, 142500},
    {310000, -66000, 82500},
    {310000, 0, 82500},
    {230000, 0, 210000},
    {230000, -25000, 210000},
    {240000, -25000, 202500},
    {240000, 0, 202500},
    {270000, 0, 240000},
    {270000, -25000, 240000},
    {330000, -25000, 240000},
    {330000, 0, 240000},
    {280000, 0, 247500},
    {280000, -25000, 247500},
    {352500, -25000, 249375},
    {352500, 0, 249375},
    {290000, 0, 247500},
    {290000, -15000, 247500},
    {345000, -15000, 251250},
    {345000, 0, 251250},
    {280000, 0, 240000},
    {280000, -15000, 240000},
    {320000, -15000, 240000},
    {320000, 0, 240000},
    {0, 0, 315000},
    {80000, 0, 315000},
    {80000, -45000, 315000},
    {45000, -80000, 315000},
    {0, -80000, 315000},
    {0, 0, 285000},
    {140000, 0, 240000},
    {140000, -78400, 240000},
    {78400, -140000, 240000},
    {0, -140000, 240000},
    {40000, 0, 255000},
    {40000, -22400, 255000},
    {22400, -40000, 255000},
    {0, -40000, 255000},
    {130000, 0, 255000},
    {130000, -72800, 255000},
    {72800, -130000, 255000},
    {0, -130000, 255000},
    {130000, 0, 240000},
    {130000, -72800, 240000},
    {72800, -130000, 240000},
    {0, -130000, 240000},
    {0, 0, 0},
    {142500, -79800, 0},
    {150000, 0, 7500},
    {142500, 0, 0},
    {79800, -142500, 0},
    {0, -150000, 7500},
    {0, -142500, 0},
    {150000, -84000, 7500},
    {84000, -150000, 7500},
};

// Rows of four control points; `quarters`: mirrored at both planes, else at one. Coordinates: u
// over a patch's width and v from its first row to its last, in pictures about 3 units large.
struct Patch {
  std::array<std::uint8_t, 16> points;
  bool quarters;
  float width;
  float v0, v1;
};
constexpr Patch patches[]{
    // rim, body, body
    {{102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, true, 1, 1.06f, 1},
    {{12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27}, true, 1, 1, 0.45f},
    {{24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40}, true, 1, 0.45f, 0},
    // the lid's knob and the lid
    {{96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3}, true, 1, 0.75f, 0.45f},
    {{0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117}, true, 1, 0.45f, 0},
    // bottom
    {{118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37},
     true,
     1,
     -0.5f,
     0},
    // handle
    {{41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56}, false, 0.3f, 0, 0.6f},
    {{53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67}, false, 0.3f, 0.6f, 1.2f},
    // spout
    {{68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83}, false, 0.5f, 0, 0.6f},
    {{80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95}, false, 0.5f, 0.6f, 0.9f},
};

using Net = std::array<Vec3, 16>;

// A cubic Bézier curve by de Casteljau's halving, which keeps points that are equal equal.
struct CurvePoint {
  Vec3 at, slope;
};
CurvePoint on_curve(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, float t) {
  const Vec3 a = mix(p0, p1, t), b = mix(p1, p2, t), c = mix(p2, p3, t);
  const Vec3 d = mix(a, b, t), e = mix(b, c, t);
  return {mix(d, e, t), (e - d) * 3};
}

struct Point {
  Vec3 position, along_s, along_t;
};
Point evaluate(const Net& net, float s, float t) {
  CurvePoint row[4];
  for (std::size_t i = 0; i < 4; ++i)
    row[i] = on_curve(net[4 * i], net[4 * i + 1], net[4 * i + 2], net[4 * i + 3], s);
  const CurvePoint down = on_curve(row[0].at, row[1].at, row[2].at, row[3].at, t);
  return {down.at, on_curve(row[0].slope, row[1].slope, row[2].slope, row[3].slope, t).at,
          down.slope};
}

// Where all points of an edge are one, a little way into the patch has a normal.
Vec3 normal_at(const Net& net, float s, float t) {
  Point p = evaluate(net, s, t);
  if (length(cross(p.along_s, p.along_t)) < 1e-6f)
    p = evaluate(net, s, t < 0.5f ? t + 1e-3f : t - 1e-3f);
  return normalised(cross(p.along_s, p.along_t));
}

// The patch mirrored as asked; `s_back`: its columns are taken from the last on, so that all
// patches are seen from outside.
Net mirrored_net(const Patch& patch, bool at_x, bool at_z) {
  Net net;
  for (std::size_t i = 0; i < 16; ++i) {
    const int* c = control_points[patch.points[i]];
    const float x = static_cast<float>(c[0]) * 1e-5f, z = static_cast<float>(c[1]) * -1e-5f;
    net[i] = {at_x ? -x : x, static_cast<float>(c[2]) * 1e-5f, at_z ? -z : z};
  }
  return net;
}

void add_patch(Mesh& mesh, const Patch& patch, bool at_x, bool at_z, int n) {
  const Net net = mirrored_net(patch, at_x, at_z);
  // A mirrored patch turns its other side out; quarters go around the pot one after the other.
  const bool back = at_x == at_z;
  const float quarter = static_cast<float>(at_x ? (at_z ? 2 : 3) : (at_z ? 1 : 0));
  add_grid(mesh, n, n, [&](float a, float b) {
    const float s = back ? 1 - a : a, t = 1 - b;
    const Vec3 normal = normal_at(net, s, t) * (back ? 1.0f : -1.0f);
    return Vertex{evaluate(net, s, t).position,
                  normal,
                  {(quarter + a) * patch.width, patch.v0 + (patch.v1 - patch.v0) * t}};
  });
}

}  // namespace

Mesh teapot(int n) {
  Mesh mesh;
  for (const Patch& patch : patches)
    for (const bool at_x : {false, true})
      for (const bool at_z : {false, true})
        if (patch.quarters || !at_x) add_patch(mesh, patch, at_x, at_z, n);
  return mesh;
}

}  // namespace gramloom
