#include "procedural/cellular.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sampling.h"

namespace gramloom {
namespace {

constexpr int period = 6;

Lattice<2> lattice() { return {{1, 1}, {0, 0}, {period, period}, 5}; }

struct Site {
  float x, y;
};

/// All feature points around the repeating square, read off through feature_point.
std::vector<Site> sites(float jitter) {
  std::vector<Site> all;
  for (int j = -4; j < period + 4; ++j)
    for (int i = -4; i < period + 4; ++i) {
      const Ints base[2] = {Ints{} + i, Ints{} + j};
      const Floats offset[2] = {Floats{}, Floats{}};
      const FeaturePoint point = feature_point(lattice(), base, offset, 0, 0, jitter);
      all.push_back({static_cast<float>(i) + point.dx[0], static_cast<float>(j) + point.dy[0]});
    }
  return all;
}

TEST(Cellular, DistancesAreThoseOfEveryPointThereIs) {
  for (const float jitter : {0.0f, 0.5f, 1.0f}) {
    const auto all = sites(jitter);
    Random random(1);
    for (int i = 0; i < 400; ++i) {
      const float x = random.uniform(0, period), y = random.uniform(0, period);
      std::vector<std::pair<float, Site>> near;
      for (const Site& s : all) near.push_back({std::hypot(s.x - x, s.y - y), s});
      std::sort(near.begin(), near.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      const Site a = near[0].second;
      float border = 100;
      for (std::size_t k = 1; k < near.size(); ++k) {
        const Site b = near[k].second;
        const float apart = std::hypot(b.x - a.x, b.y - a.y);
        border = std::min(
            border,
            ((b.x - a.x) * ((a.x + b.x) / 2 - x) + (b.y - a.y) * ((a.y + b.y) / 2 - y)) / apart);
      }
      const Cells cell = cells(lattice(), point<2>({x, y}), jitter);
      EXPECT_NEAR(cell.first[0], near[0].first, 1e-5);
      EXPECT_NEAR(cell.second[0], near[1].first, 1e-5);
      EXPECT_NEAR(cell.border[0], border, 1e-4);
    }
  }
}

TEST(Cellular, WithoutJitterItIsASquareGrid) {
  const Cells cell = cells(lattice(), point<2>({2.75f, -1.5f}), 0);
  EXPECT_FLOAT_EQ(cell.first[0], 0.25f);
  EXPECT_FLOAT_EQ(cell.second[0], 0.75f);
  EXPECT_FLOAT_EQ(cell.border[0], 0.25f);
}

TEST(Cellular, RepeatsExactlyAfterItsPeriod) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const float x = std::round(random.uniform(-6, 6) * 64) / 64,
                y = std::round(random.uniform(-6, 6) * 64) / 64;
    const Cells a = cells(lattice(), point<2>({x, y}), 1, 0.1f);
    const Cells b = cells(lattice(), point<2>({x + period, y - 2 * period}), 1, 0.1f);
    EXPECT_EQ(a.first[0], b.first[0]);
    EXPECT_EQ(a.border[0], b.border[0]);
    EXPECT_EQ(a.rounded[0], b.rounded[0]);
    EXPECT_EQ(a.id[0], b.id[0]);
  }
}

TEST(Cellular, ASoftMinimumOf24BordersIsCloseToTheirMinimum) {
  Random random(3);
  for (const float rounding : {0.01f, 0.1f})
    for (int i = 0; i < 200; ++i) {
      const Cells cell =
          cells(lattice(), point<2>({random.uniform(0, 6), random.uniform(0, 6)}), 1, rounding);
      EXPECT_LE(cell.rounded[0], cell.border[0] + 1e-5f);
      EXPECT_GE(cell.rounded[0], cell.border[0] - rounding * std::log(24.0f));
    }
}

}  // namespace
}  // namespace gramloom
