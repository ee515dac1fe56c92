#include "signal/share_labels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gramloom {
namespace {

Target shared_by(const std::vector<float>& weights) {
  Target target{{90, 70}, Tile::both};
  target.weights = Image(1, 1, static_cast<int>(weights.size()));
  target.weights.pixels = weights;
  return target;
}

TEST(ShareLabels, HaveTheirSharesInIslands) {
  const Image labels = labels_of_shares(shared_by({2, 1, 0, 3}), Random(1));
  ASSERT_EQ(labels.size(), (Size{90, 70}));
  std::vector<double> sums(4);
  int changes = 0;
  for (int y = 0; y < labels.height; ++y)
    for (int x = 0; x < labels.width; ++x) {
      const float* p = labels.at(x, y);
      EXPECT_EQ(p[0] + p[1] + p[2] + p[3], 1);
      for (std::size_t i = 0; i < 4; ++i) sums[i] += double{p[i]};
      changes += x > 0 && !std::equal(p, p + 4, labels.at(x - 1, y)) ? 1 : 0;
    }
  EXPECT_EQ(sums, (std::vector<double>{2100, 1050, 0, 3150}));
  EXPECT_LT(changes, 6300 / 8) << "runs are many pixels long";
}

TEST(ShareLabels, OfOneExemplarAreThatEverywhere) {
  const Image labels = labels_of_shares(shared_by({0, 5}), Random(1));
  for (std::size_t i = 0; i < labels.pixels.size(); ++i)
    ASSERT_EQ(labels.pixels[i], i % 2 == 1 ? 1 : 0);
}

}  // namespace
}  // namespace gramloom
