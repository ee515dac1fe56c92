#include "signal/courses.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "courses.h"

namespace gramloom {
namespace {

TEST(Courses, OfAWallHaveTheirPeriodAlongItsHeightOnly) {
  for (const Size brick : {Size{40, 16}, {30, 23}, {64, 27}}) {
    const Image wall = wall_of_bricks({256, 200}, brick, 0.15f);
    const Courses rows = find_courses(wall, Axis::y);
    EXPECT_GT(rows.contrast, clear_courses) << brick.height;
    EXPECT_NEAR(rows.period, brick.height, 0.02 * brick.height + 0.3);
    EXPECT_LT(find_courses(wall, Axis::x).contrast, clear_courses);
  }
}

TEST(Courses, OfTilesAreThereOnBothAxes) {
  Image tiles({180, 240}, 3, 0.7f);
  for (int y = 0; y < tiles.height; ++y)
    for (int x = 0; x < tiles.width; ++x)
      if (x % 30 < 3 || y % 40 < 4)
        for (int c = 0; c < 3; ++c) tiles.at(x, y)[c] = 0.2f;
  const Courses rows = find_courses(tiles, Axis::y), columns = find_courses(tiles, Axis::x);
  EXPECT_NEAR(rows.period, 40, 1);
  EXPECT_NEAR(columns.period, 30, 1);
  EXPECT_GT(std::min(rows.contrast, columns.contrast), clear_courses);
  EXPECT_FALSE(rows.alternate);
}

TEST(Courses, OfBricksAlternate) {
  EXPECT_TRUE(find_courses(wall_of_bricks({240, 240}, {60, 20}, 0.1f), Axis::y).alternate);
}

TEST(Courses, AreNotInNoiseNorInAFlatOrATinyPicture) {
  Image noise({128, 128}, 3);
  Random random(2);
  for (float& value : noise.pixels) value = random.uniform();
  for (const Axis axis : {Axis::x, Axis::y}) {
    EXPECT_LT(find_courses(noise, axis).contrast, clear_courses);
    EXPECT_EQ(find_courses(Image({64, 64}, 3, 0.5f), axis).contrast, 0);
    EXPECT_EQ(find_courses(Image({3, 1}, 1, 0.5f), axis).contrast, 0);
  }
}

}  // namespace
}  // namespace gramloom
