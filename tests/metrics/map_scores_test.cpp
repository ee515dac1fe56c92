#include "metrics/map_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/random.h"

namespace gramloom {
namespace {

// Normals that lean to the right by these degrees, column by column.
Image leaning(Size size, const auto& degrees) {
  Image normals(size, 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const double angle = degrees(x) * std::numbers::pi / 180;
      normals.at(x, y)[0] = static_cast<float>((std::sin(angle) + 1) / 2);
      normals.at(x, y)[1] = 0.5f;
      normals.at(x, y)[2] = static_cast<float>((std::cos(angle) + 1) / 2);
    }
  return normals;
}

std::map<std::string_view, double> scores(const Image& a, const Image& b, MapKind kind) {
  const auto list = score_map(a, b, kind);
  return {list.begin(), list.end()};
}

TEST(MapScores, OfTheSameMapAreZero) {
  const Image normals = leaning({20, 16}, [](int x) { return 3.0 * x - 20; });
  for (const MapKind kind : {MapKind::normal, MapKind::scalar, MapKind::colour, MapKind::alpha})
    for (const auto& [name, value] : score_map(normals, normals, kind))
      EXPECT_NEAR(value, 0, 1e-9) << name;
}

// A plane turned by 10 degrees: 10 from the vertical; from the other directions what the turn
// changes there, and no bend anywhere.
TEST(MapScores, ATurnedPlaneIsAsManyDegreesAway) {
  const auto found = scores(leaning({20, 16}, [](int) { return 0; }),
                            leaning({33, 9}, [](int) { return 10; }), MapKind::normal);
  const double slant = std::sqrt(0.5), turn = 10 * std::numbers::pi / 180;
  double sum = 10;
  for (int i = 0; i < 8; ++i) {
    const double x = slant * std::cos(i * std::numbers::pi / 4);
    const double cosine = x * std::sin(turn) + slant * std::cos(turn);
    sum += std::abs(std::acos(cosine) * 180 / std::numbers::pi - 45);
  }
  EXPECT_NEAR(found.at("normal_angle"), sum / 9, 1e-3);
  EXPECT_NEAR(found.at("normal_bend"), 0, 1e-3);
}

TEST(MapScores, ShuffledNormalsBendOtherwise) {
  const Image smooth = leaning({64, 8}, [](int x) { return 20 * std::sin(x / 5.0); });
  Image shuffled = smooth;
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto a = random.below(512) * 3, b = random.below(512) * 3;
    std::swap_ranges(shuffled.pixels.begin() + a, shuffled.pixels.begin() + a + 3,
                     shuffled.pixels.begin() + b);
  }
  const auto found = scores(smooth, shuffled, MapKind::normal);
  EXPECT_NEAR(found.at("normal_angle"), 0, 1e-6);
  EXPECT_GT(found.at("normal_bend"), 3);
}

TEST(MapScores, ScalarsAreMeasuredInTheExemplarsDeviations) {
  Image map({40, 30}, 1), moved = map;
  for (int i = 0; i < 1200; ++i) {
    map.pixels[static_cast<std::size_t>(i)] = i % 2 ? 0.2f : 0.4f;  // a deviation of 0.1
    moved.pixels[static_cast<std::size_t>(i)] = (i % 2 ? 0.2f : 0.4f) + 0.05f;
  }
  const auto found = scores(map, moved, MapKind::scalar);
  EXPECT_NEAR(found.at("value_distance"), 0.5, 1e-5);
  EXPECT_NEAR(found.at("step_distance"), 0, 1e-5);
  for (float& value : moved.pixels) value = 0.3f;
  EXPECT_NEAR(scores(map, moved, MapKind::scalar).at("step_distance"), 1, 1e-5);
}

TEST(MapScores, EachHasALineInTheListAndWrongMapsAreRefused) {
  for (const MapKind kind : {MapKind::normal, MapKind::scalar})
    for (const auto& [name, value] :
         score_map(Image({4, 4}, 3, 0.5f), Image({2, 1}, 3, 0.5f), kind))
      EXPECT_TRUE(std::ranges::any_of(map_metrics(), [&](const Metric& m) {
        return m.name == name;
      })) << name;
  EXPECT_THROW(score_map(Image({4, 4}, 3), Image({4, 4}, 1), MapKind::scalar), Error);
  EXPECT_THROW(score_map(Image(), Image(), MapKind::scalar), Error);
}

}  // namespace
}  // namespace gramloom
