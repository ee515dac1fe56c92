#include "signal/united.h"

#include <gtest/gtest.h>

namespace gramloom {
namespace {

Image numbered(Size size, float from) {
  Image image(size, 1);
  for (float& value : image.pixels) value = from++;
  return image;
}

TEST(United, OneWithoutAMaskIsTakenAsItIs) {
  const Request request{{{numbered({4, 3}, 0)}}, {{8, 8}}};
  const United united(request);
  EXPECT_EQ(&united.exemplar(), &request.exemplars.front());
  EXPECT_EQ(&united.guide(), &request.target.guide);
}

TEST(United, LieSideBySideWithMaskedGaps) {
  Request request{{{numbered({4, 3}, 0)}, {numbered({2, 5}, 100)}}, {{8, 8}}};
  request.exemplars[1].mask = Image(2, 5, 1, 1.0f);
  *request.exemplars[1].mask.at(1, 4) = 0;
  const United united(request);
  const Exemplar& all = united.exemplar();
  ASSERT_EQ(all.image.size(), (Size{7, 5}));
  int usable = 0;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      if (*all.mask.at(x, y) < 0.5f) continue;
      ++usable;
      const Source from = united.source(x, y);
      EXPECT_EQ(*all.image.at(x, y), *request.exemplars[from.exemplar].image.at(
                                         static_cast<int>(from.x), static_cast<int>(from.y)));
    }
  EXPECT_EQ(usable, 4 * 3 + 2 * 5 - 1);
  EXPECT_EQ(*all.image.at(4, 1), *all.image.at(3, 1)) << "what is masked has its neighbour's value";
}

TEST(United, WeightsBecomeAGuideOfShares) {
  Request request{{{numbered({4, 3}, 0)}, {numbered({2, 5}, 100)}}, {{3, 2}}};
  request.target.weights = Image(1, 1, 2, 3.0f);
  request.target.weights.pixels[1] = 1;
  const United united(request);
  ASSERT_EQ(united.guide().size(), (Size{3, 2}));
  const float one = united.exemplar().guide.at(0, 0)[0];
  EXPECT_GT(one, 0);
  EXPECT_EQ(united.guide().at(2, 1)[0], 0.75f * one);
  EXPECT_EQ(united.guide().at(2, 1)[1], 0.25f * one);
  EXPECT_EQ(united.exemplar().guide.at(6, 4)[1], one);
  EXPECT_EQ(united.exemplar().guide.at(6, 4)[0], 0);
}

TEST(UsableOrigins, AreThoseOfPatchesWithoutAMaskedPixel) {
  Image mask(6, 5, 1, 1.0f);
  *mask.at(3, 2) = 0;
  const auto usable = usable_origins(mask, {6, 5}, {3, 2});
  ASSERT_EQ(usable.size(), 4u * 4u);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(usable[static_cast<std::size_t>(4 * y + x)] == 0,
                x <= 3 && 3 < x + 3 && y <= 2 && 2 < y + 2)
          << x << ", " << y;
}

}  // namespace
}  // namespace gramloom
