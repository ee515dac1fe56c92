#include "surface/cloth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "surface/arm.h"

namespace gramloom {
namespace {

double square_sum(const Image& picture) {
  double sum = 0;
  for (const float value : picture.pixels) sum += static_cast<double>(value) * value;
  return sum;
}

// The difference of two pictures as a share of the first.
double difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(static_cast<double>(a.pixels[i] - b.pixels[i]), 2);
  return std::sqrt(sum / square_sum(a));
}

// Left and right exchanged: the mirror plane is the one that the arm bends in.
Image mirrored(const Image& picture) {
  Image result = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      *result.at(x, y) = *picture.at(picture.width - 1 - x, y);
  return result;
}

// How much longer or shorter edges are than at rest, sorted.
std::vector<double> strains(const ClothSheet& sheet, const ClothParams& params) {
  std::vector<double> strains;
  const auto add = [&](std::size_t a, std::size_t b, double rest) {
    const auto square = [](float d) { return static_cast<double>(d) * static_cast<double>(d); };
    const double length =
        std::sqrt(square(sheet.x[a] - sheet.x[b]) + square(sheet.y[a] - sheet.y[b]) +
                  square(sheet.z[a] - sheet.z[b]));
    strains.push_back(std::abs(length / rest - 1));
  };
  const double down = arm_length / params.size.height;
  const double across = 2 * std::sin(3.14159265358979 / params.size.width);
  for (int row = 0; row < sheet.rows; ++row)
    for (int column = 0; column < sheet.around; ++column) {
      const std::size_t i = sheet.first(row) + static_cast<std::size_t>(column);
      add(i, sheet.first(row) + static_cast<std::size_t>((column + 1) % sheet.around), across);
      if (row + 1 < sheet.rows) add(i, i + static_cast<std::size_t>(sheet.around), down);
    }
  std::sort(strains.begin(), strains.end());
  return strains;
}

TEST(Cloth, AStraightArmHasASmoothSleeve) {
  const Image picture = sleeve_displacement({}, {});
  for (const float value : picture.pixels) ASSERT_NEAR(value, 0, 1e-4f);
}

TEST(Cloth, EdgesKeepTheirLengths) {
  const ClothParams params;
  for (const Pose& pose : {Pose{60, 0, 0}, Pose{110, 0, 0}, Pose{80, 60, -60}}) {
    const auto sorted = strains(bent_sleeve(params, pose), params);
    const auto at = [&](double share) {
      return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    EXPECT_LT(at(0.5), 0.03) << pose.bend;
    EXPECT_LT(at(0.95), 0.12) << pose.bend;
    EXPECT_LT(at(1), 0.6) << pose.bend;
  }
}

TEST(Cloth, NoneIsInsideTheArm) {
  const ClothParams params;
  for (const Pose& pose : {Pose{40, 30, 0}, Pose{110, 0, 60}, Pose{120, -120, 120}}) {
    const ArmAxis axis(pose.bend);
    const ClothSheet sheet = bent_sleeve(params, pose);
    for (std::size_t i = 0; i < sheet.count(); ++i) {
      const ArmPlace place =
          place_of(axis, {static_cast<double>(sheet.x[i]), static_cast<double>(sheet.y[i]),
                          static_cast<double>(sheet.z[i])});
      ASSERT_GE(place.from, 1 - params.slack - 1e-5);
    }
    for (const float value : sleeve_displacement(params, pose).pixels)
      ASSERT_GE(value, static_cast<float>(-params.slack) - 1e-5f);
  }
}

TEST(Cloth, FoldsLieOnTheInsideAndTheOutsideIsTaut) {
  const Image picture = sleeve_displacement({}, {80, 0, 0});
  // How much a column changes from row to row around the elbow.
  const auto roughness = [&](int x) {
    double sum = 0;
    for (int y = 20; y < 44; ++y)
      sum += std::pow(static_cast<double>(*picture.at(x, y) - *picture.at(x, y - 1)), 2);
    return sum;
  };
  EXPECT_GT(roughness(32), 5 * roughness(0));
  EXPECT_LT(*picture.at(0, 32), -0.2f) << "drawn onto the arm";
  EXPECT_GT(*std::max_element(picture.pixels.begin(), picture.pixels.end()), 0.1f);
}

TEST(Cloth, ASymmetricPoseHasSymmetricFolds) {
  for (const double bend : {40.0, 90.0}) {
    const Image picture = sleeve_displacement({}, {bend, 0, 0});
    EXPECT_LT(difference(picture, mirrored(picture)), 0.1) << bend;
  }
  const Image left = sleeve_displacement({}, {60, 40, -30});
  EXPECT_LT(difference(left, mirrored(sleeve_displacement({}, {60, -40, 30}))), 0.15);
  EXPECT_GT(difference(left, mirrored(left)), 0.5);
}

// What a network is to learn must not leap from one pose to the next.
TEST(Cloth, SimilarPosesHaveSimilarFolds) {
  for (const Pose& pose : {Pose{40, 0, 0}, Pose{80, 40, 20}}) {
    const Image picture = sleeve_displacement({}, pose);
    EXPECT_LT(difference(picture, sleeve_displacement({}, {pose.bend + 1, pose.twist, pose.swing})),
              0.2);
    EXPECT_GT(
        difference(picture, sleeve_displacement({}, {pose.bend + 20, pose.twist, pose.swing})),
        0.2);
  }
}

TEST(Cloth, TheSameBytesOnEveryMachine) {
  ClothParams params;
  params.size = {24, 32};
  params.steps = 10;
  params.iterations = 4;
  const Image picture = sleeve_displacement(params, {75, 30, -20});
  Fnv1a hash;
  hash.add(picture.pixels.data(), picture.pixels.size() * sizeof(float));
  EXPECT_EQ(hash.text(), "852169979a9a6ec0");
}

// Whatever is allowed ends in a picture.
TEST(Cloth, ExtremesStayFinite) {
  ClothParams params;
  params.size = {8, 9};
  for (const double stiffness : {0.0, 1.0})
    for (const double fold : {0.0, 2.0}) {
      params.shear = params.bending = stiffness;
      params.fold = fold;
      params.slack = 0.6 * stiffness;
      for (const Pose& pose : {Pose{120, 120, 120}, Pose{120, -120, 120}, Pose{1e-5, 0, 0}})
        for (const float value : sleeve_displacement(params, pose).pixels)
          ASSERT_TRUE(std::abs(value) <= 2) << stiffness << " " << fold << " " << value;
    }
}

TEST(Cloth, WhatIsOutOfRangeIsRefused) {
  EXPECT_THROW(sleeve_displacement({}, {-1, 0, 0}), ConfigError);
  ClothParams params;
  params.steps = 0;
  EXPECT_THROW(sleeve_displacement(params, {}), ConfigError);
}

}  // namespace
}  // namespace gramloom
