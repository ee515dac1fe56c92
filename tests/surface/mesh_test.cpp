#include "surface/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <map>

#include "core/error.h"
#include "io/temp_folder.h"
#include "io/text_file.h"
#include "surface/arm.h"
#include "surface/displacement.h"
#include "surface/mesh_file.h"
#include "surface/shapes.h"

namespace gramloom {
namespace {

constexpr Shape every_shape[]{Shape::sphere,   Shape::plane,  Shape::cube,
                              Shape::cylinder, Shape::teapot, Shape::tube};

// Six times the signed volume: positive where triangles are counter-clockwise from outside.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += static_cast<double>(
        dot(mesh.positions[t[0]], cross(mesh.positions[t[1]], mesh.positions[t[2]])));
  return sum / 6;
}

TEST(Shapes, AreWholeAndSeenFromOutside) {
  for (const Shape shape : every_shape) {
    const Mesh mesh = make_shape(shape, 0.2f);
    EXPECT_NO_THROW(check_mesh(mesh, "shape"));
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
    EXPECT_EQ(mesh.coordinates.size(), mesh.positions.size());
    int agree = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3& a = mesh.positions[t[0]];
      const Vec3 face = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
      agree += dot(face, mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]) > 0;
    }
    // Around the tip of the teapot's knob the patches themselves fold.
    const double least = shape == Shape::teapot ? 0.998 : 1;
    EXPECT_GE(agree, least * static_cast<double>(mesh.triangles.size())) << to_word(shape);
  }
  EXPECT_NEAR(volume(make_shape(Shape::sphere, 0.1f)), 4.18879, 0.02);
  EXPECT_NEAR(volume(make_shape(Shape::cube, 0.1f)), 1.4 * 1.4 * 1.4, 1e-4);
  EXPECT_NEAR(volume(make_shape(Shape::cylinder, 0.1f)), 3.14159 * 0.49 * 1.4, 0.01);
}

TEST(Shapes, TheTubeBendsAsAnElbow) {
  for (const double bend : {0.0, 70.0, 120.0}) {
    const Mesh mesh = make_shape(Shape::tube, 0.1f, bend);
    EXPECT_NO_THROW(check_mesh(mesh, "tube"));
    const ArmAxis axis(bend);
    // Where it was put: the same for all vertices.
    const auto at = [&](std::size_t i) {
      const Vec2 c = mesh.coordinates[i];
      const ArmPoint p = point_at(
          axis, {(0.5 - static_cast<double>(c.v)) * arm_length, static_cast<double>(c.u), 1});
      return Vec3{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)} *
             0.25f;
    };
    const Vec3 moved = mesh.positions.front() - at(0);
    float radius = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_LT(length(mesh.positions[i] - at(i) - moved), 1e-5f);
      radius = std::max(radius, length(mesh.positions[i]));
    }
    EXPECT_LT(radius, 1.05f);
    for (const auto& t : mesh.triangles) {
      const Vec3& a = mesh.positions[t[0]];
      const Vec3 face = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
      ASSERT_GT(dot(face, mesh.normals[t[0]]), 0);
    }
  }
}

TEST(Shapes, TheTeapotIsNewells) {
  const Mesh pot = teapot(8);
  float low = 9, high = -9, left = 9, right = -9;
  for (const Vec3& p : pot.positions) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
    left = std::min(left, p.x);
    right = std::max(right, p.x);
  }
  EXPECT_NEAR(low, 0, 1e-4f);
  EXPECT_NEAR(high, 3.15f, 1e-4f);
  EXPECT_NEAR(left, -3, 1e-3f);
  EXPECT_NEAR(right, 3.43f, 0.05f);
  // 28 patches and the bottom's four, of 64 pairs of triangles, but at the lid's top and the
  // bottom's middle, where one side of a patch is a point.
  EXPECT_EQ(pot.triangles.size(), 32u * 128 - 8 * 8);
  EXPECT_GT(volume(pot), 0);
}

TEST(Mesh, SmoothNormalsByAreaAndByAngle) {
  // A corner of a cube whose faces are split unevenly: by angle the diagonal, by area not.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 3}, {1, 1, 0}};
  mesh.normals.resize(5);
  mesh.triangles = {{0, 3, 2}, {0, 1, 3}, {0, 2, 4}, {0, 4, 1}};
  const Vec3 angle = smooth_normals(mesh, NormalWeights::angle)[0];
  EXPECT_NEAR(angle.x, -std::sqrt(1 / 3.0f), 1e-6f);
  EXPECT_NEAR(angle.z, -std::sqrt(1 / 3.0f), 1e-6f);
  // Areas: 3/2 towards −x and −y, 2 · ½ towards −z.
  const Vec3 area = smooth_normals(mesh, NormalWeights::area)[0];
  const Vec3 expected = normalised({-1.5f, -1.5f, -1});
  EXPECT_NEAR(area.x, expected.x, 1e-6f);
  EXPECT_NEAR(area.z, expected.z, 1e-6f);
}

TEST(Mesh, SmoothNormalsOfABallAreItsRadiiAcrossItsSeamToo) {
  const Mesh ball = make_shape(Shape::sphere, 0.1f);
  for (const NormalWeights weights : {NormalWeights::area, NormalWeights::angle}) {
    const auto normals = smooth_normals(ball, weights);
    for (std::size_t i = 0; i < normals.size(); ++i)
      EXPECT_GT(dot(normals[i], ball.positions[i]), 0.9998f);
  }
}

TEST(Mesh, SubdividedEdgesAreShortAndNoCrackOpens) {
  Mesh mesh = subdivided(make_shape(Shape::cube, 9), 0.3f);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto place = same_places(mesh);
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = place[t[i]], b = place[t[(i + 1) % 3]];
      EXPECT_LE(length(mesh.positions[a] - mesh.positions[b]), 0.3f);
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  for (const auto& [edge, faces] : edges) EXPECT_EQ(faces, 2);
  EXPECT_NEAR(volume(mesh), 1.4 * 1.4 * 1.4, 1e-4);
}

TEST(Mesh, DisplacedByZeroIsTheSameAndSeamsStayClosed) {
  const Mesh mesh = make_shape(Shape::sphere, 0.2f);
  std::vector<float> heights(mesh.positions.size());
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i % 7) / 7;
  const auto still = displaced(mesh, heights, 0);
  for (std::size_t i = 0; i < still.size(); ++i)
    EXPECT_NEAR(length(still[i] - mesh.positions[i]), 0, 1e-6f);
  const auto moved = displaced(mesh, heights, 0.1f);
  const auto place = same_places(mesh);
  for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_EQ(moved[i], moved[place[i]]);
  const auto even = displaced(mesh, std::vector<float>(heights.size(), 1), 0.25f);
  for (const Vec3& p : even) EXPECT_NEAR(length(p), 1.25f, 1e-5f);
}

TEST(Mesh, ADisplacedCubeKeepsFlatFacesAndSharpEdges) {
  const Mesh mesh = make_shape(Shape::cube, 0.5f);
  Mesh larger = mesh;
  larger.positions = displaced(mesh, std::vector<float>(mesh.positions.size(), 1), 0.1f);
  EXPECT_NEAR(volume(larger), 1.6 * 1.6 * 1.6, 1e-4);
}

std::string refusal(const Mesh& mesh) {
  try {
    check_mesh(mesh, "m.obj");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Mesh, WhatCannotBeUsedIsToldInALine) {
  const Mesh good = make_shape(Shape::cube, 9);
  EXPECT_EQ(refusal(good), "");
  EXPECT_EQ(refusal({}), "m.obj: a mesh of 0 faces, it needs 1 at least");
  Mesh bad = good;
  bad.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(bad), "m.obj: vertex 4 has a value that is not a finite number");
  bad = good;
  bad.triangles[5] = {0, 1, 1};
  EXPECT_EQ(refusal(bad), "m.obj: triangle 6 has no area: its corners must not lie on one line");
  bad = good;
  bad.triangles.resize(10'000'000, bad.triangles[0]);
  EXPECT_EQ(refusal(bad), "m.obj: a mesh of 10000000 triangles, allowed are 4000000");
}

class MeshFile : public TempFolder {
 protected:
  Mesh read(const std::string& text) {
    write_text(path("m.obj"), text);
    return read_mesh(path("m.obj"));
  }
  // Without the folder.
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      const std::string what = error.what();
      return what.substr(what.find("m.obj"));
    }
    return "";
  }
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Where nobody writes, a reader of materials would wait for ever: the mesh's file is opened here
// and read by its descriptor's name, beside which "0" is the program's input.
TEST_F(MeshFile, NoFileOfMaterialsIsOpened) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const Mesh found = read(fmt::format(
      "mtllib {}\nmtllib none.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ends[0]));
  EXPECT_EQ(found.triangles.size(), 1u);
  for (const int end : ends) close(end);
}

TEST_F(MeshFile, PolygonsBecomeTrianglesWithNormalsAndCoordinates) {
  const Mesh mesh = read(square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.coordinates.size(), 4u);
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(n.z, 1, 1e-6f);
  EXPECT_TRUE(read(square + "f 1 2 3\n").coordinates.empty());
}

// A tent of two sheets that share no vertex: its normals are smooth across the ridge.
TEST_F(MeshFile, TheUnitOfLengthDoesNotMatter) {
  const Mesh one =
      read("v 0 0 0\nv 1 0 1\nv 0 1 0\nv 0 0 0\nv 0 1 0\nv -1 0 1\nf 1 2 3\nf 4 5 6\n");
  EXPECT_NEAR(length(one.normals[0] - one.normals[3]), 0, 1e-6f);
  for (const std::string e : {"e-30", "e-6", "e6", "e30", "e38"}) {
    const std::string v = "v 0 0 0\nv 1" + e + " 0 1" + e + "\nv 0 1" + e + " 0\n" +
                          "v 0 0 0\nv 0 1" + e + " 0\nv -1" + e + " 0 1" + e + "\n";
    const Mesh other = read(v + "f 1 2 3\nf 4 5 6\n");
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_LT(length(other.positions[i] - one.positions[i]), 1e-5f) << e;
      EXPECT_LT(length(other.normals[i] - one.normals[i]), 1e-5f) << e;
    }
  }
}

TEST_F(MeshFile, VerySmallTrianglesBesideLargeOnesAreRead) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 2 3\nf 1 4 5\n"), "");
}

TEST_F(MeshFile, BadFilesAreToldInALine) {
  EXPECT_EQ(refusal("v 0 0 0\n"), "m.obj: a mesh of 0 faces, it needs 1 at least");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 nan 0\nv 1 1 0\nf 1 2 3\n"),
            "m.obj:2: 'nan' is not a finite number");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 1e99 0\nv 1 1 0\nf 1 2 3\n"),
            "m.obj:2: '1e99' is not a finite number");
  EXPECT_EQ(refusal(square + "f 1 2 2\n"),
            "m.obj: triangle 1 has no area: its corners must not lie on one line");
  EXPECT_EQ(refusal(square + "f 1 2 9\n"), "m.obj: a face names vertex 9, the file has 4");
  EXPECT_THAT(refusal(std::string("\x89PNG\x01\x02")), testing::StartsWith("m.obj: "));
  EXPECT_THROW(read_mesh(path("none.obj")), Error);
  EXPECT_THROW(read_mesh(path()), Error);
}

TEST_F(MeshFile, TenMillionFacesAreRefusedBeforeTheyAreRead) {
  std::string text = square;
  std::string faces;
  for (int i = 0; i < 1000; ++i) faces += "f 1 2 3\n";
  for (int i = 0; i < 10000; ++i) text += faces;
  EXPECT_EQ(refusal(text), "m.obj: a mesh of 10000000 faces, allowed are 4000000");
}

}  // namespace
}  // namespace gramloom
