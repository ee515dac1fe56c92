#include "classic/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace gramloom {
namespace {

TEST(Histogram, DrawsColoursByTheirShare) {
  // Four colours with shares 1/2, 1/4, 3/16, 1/16, told apart by two channels together.
  Image exemplar(4, 4, 2);
  const std::map<std::pair<float, float>, int> shares{
      {{0, 0}, 8}, {{0, 1}, 4}, {{1, 0}, 3}, {{1, 1}, 1}};
  int i = 0;
  for (const auto& [colour, count] : shares)
    for (int k = 0; k < count; ++k, ++i) {
      exemplar.at(i % 4, i / 4)[0] = colour.first;
      exemplar.at(i % 4, i / 4)[1] = colour.second;
    }
  const Image image =
      synthesise(HistogramParams{}, {{{exemplar}}, Target{{400, 250}}, Random(1)}, Control{}).image;
  std::map<std::pair<float, float>, int> seen;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) ++seen[{image.at(x, y)[0], image.at(x, y)[1]}];
  ASSERT_EQ(seen.size(), 4u);
  double chi2 = 0;  // 3 degrees of freedom: above 16.3 in one case of a thousand
  for (const auto& [colour, count] : shares) {
    const double expected = 1e5 * count / 16;
    chi2 += (seen[colour] - expected) * (seen[colour] - expected) / expected;
  }
  EXPECT_LT(chi2, 16.3);
}

TEST(Histogram, PixelsAreIndependent) {
  Image exemplar(2, 1, 1);
  *exemplar.at(0, 0) = 1;
  *exemplar.at(1, 0) = -1;
  const Image image =
      synthesise(HistogramParams{}, {{{exemplar}}, Target{{500, 200}}, Random(2)}, Control{}).image;
  double right = 0, down = 0;
  for (int y = 0; y + 1 < image.height; ++y)
    for (int x = 0; x + 1 < image.width; ++x) {
      right += static_cast<double>(*image.at(x, y) * *image.at(x + 1, y));
      down += static_cast<double>(*image.at(x, y) * *image.at(x, y + 1));
    }
  EXPECT_LT(std::abs(right / 1e5), 0.013);  // four standard errors
  EXPECT_LT(std::abs(down / 1e5), 0.013);
}

}  // namespace
}  // namespace gramloom
