#include "neural/network/feature_maps.h"

#include <gtest/gtest.h>

#include "tensors.h"

namespace gramloom::neural {
namespace {

TEST(FeatureMaps, BlocksKeepEveryChannelInItsPlace) {
  for (const int channels : {1, 3, 8, 16, 17, 40}) {
    const at::Tensor planes = numbers({channels, 5, 7}, 1);
    const FeatureMaps maps = to_maps(planes);
    EXPECT_EQ(maps.channels, channels);
    EXPECT_TRUE(at::equal(to_planes(maps), planes));
    EXPECT_TRUE(at::equal(to_rows(maps), planes.reshape({channels, -1}).t()));
  }
}

TEST(FeatureMaps, ConcatenatesPartsThatDoNotFillTheirBlocks) {
  const at::Tensor a = numbers({16, 4, 4}, 1), b = numbers({5, 4, 4}, 2), c = numbers({7, 4, 4}, 3);
  EXPECT_TRUE(at::equal(to_planes(concatenate({to_maps(a), to_maps(b)})), at::cat({a, b})));
  EXPECT_TRUE(
      at::equal(to_planes(concatenate({to_maps(b), to_maps(c), to_maps(a)})), at::cat({b, c, a})));
}

// What lies at position i of an axis of this length, by the definition; −1: zero.
std::int64_t plain_source(std::int64_t i, std::int64_t length, Padding padding) {
  if (padding == Padding::zero) return i >= 0 && i < length ? i : -1;
  while (i < 0 || i >= length) {
    if (padding == Padding::circular)
      i += i < 0 ? length : -length;
    else
      i = i < 0 ? -1 - i : 2 * length - 1 - i;
  }
  return i;
}

class PaddingTest : public testing::TestWithParam<std::tuple<Padding, Padding, int>> {};

TEST_P(PaddingTest, EqualsThePlainDefinition) {
  const auto [x_padding, y_padding, radius] = GetParam();
  const at::Tensor planes = numbers({3, 4, 6}, 5, at::kDouble);
  const at::Tensor padded = pad_planes(planes, radius, {x_padding, y_padding});
  const std::int64_t rx = x_padding == Padding::valid ? 0 : radius;
  const std::int64_t ry = y_padding == Padding::valid ? 0 : radius;
  ASSERT_EQ(padded.sizes(), at::IntArrayRef({3, 4 + 2 * ry, 6 + 2 * rx}));
  for (std::int64_t y = 0; y < padded.size(1); ++y)
    for (std::int64_t x = 0; x < padded.size(2); ++x) {
      const auto sy = ry ? plain_source(y - ry, 4, y_padding) : y;
      const auto sx = rx ? plain_source(x - rx, 6, x_padding) : x;
      const double expected = sy < 0 || sx < 0 ? 0 : planes[1][sy][sx].item<double>();
      ASSERT_EQ(padded[1][y][x].item<double>(), expected) << y << ' ' << x;
    }
  EXPECT_TRUE(at::equal(to_planes(pad(to_maps(planes), radius, {x_padding, y_padding})), padded));
}

TEST_P(PaddingTest, GradientIsTheAdjoint) {  // <pad(a), b> = <a, padᵀ(b)>
  const auto [x_padding, y_padding, radius] = GetParam();
  const at::Tensor a = numbers({2, 4, 6}, 6, at::kDouble).requires_grad_(true);
  const at::Tensor padded = pad_planes(a, radius, {x_padding, y_padding});
  const at::Tensor b = numbers(padded.sizes(), 7, at::kDouble);
  (padded * b).sum().backward();
  EXPECT_NEAR((a.detach() * a.grad()).sum().item<double>(),
              (padded.detach() * b).sum().item<double>(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(AllEdges, PaddingTest,
                         testing::Combine(testing::Values(Padding::circular, Padding::reflect,
                                                          Padding::zero, Padding::valid),
                                          testing::Values(Padding::circular, Padding::reflect,
                                                          Padding::valid),
                                          testing::Values(1, 3, 15)));  // 15: longer than the axes

TEST(Pool, EqualsThePlainLoopAndLeavesAnOddEdgeOut) {
  const at::Tensor planes = numbers({20, 7, 5}, 8);
  const at::Tensor average = to_planes(pool(to_maps(planes), PoolKind::average));
  const at::Tensor largest = to_planes(pool(to_maps(planes), PoolKind::max));
  ASSERT_EQ(average.sizes(), at::IntArrayRef({20, 3, 2}));
  for (int c = 0; c < 20; ++c)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 2; ++x) {
        double sum = 0, most = -1e9;
        for (int i = 0; i < 4; ++i) {
          const double value = planes[c][2 * y + i / 2][2 * x + i % 2].item<double>();
          sum += value;
          most = std::max(most, value);
        }
        ASSERT_NEAR(average[c][y][x].item<double>(), sum / 4, 1e-6);
        ASSERT_EQ(largest[c][y][x].item<double>(), most);
      }
}

}  // namespace
}  // namespace gramloom::neural
