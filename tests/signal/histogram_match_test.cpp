#include "signal/histogram_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/random.h"
#include "core/threads.h"

namespace gramloom {
namespace {

using testing::ElementsAre;
using testing::FloatEq;
using testing::Pointwise;

std::vector<float> normals(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> values(count);
  for (float& v : values) v = random.normal();
  return values;
}

std::vector<float> std_sorted(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  return values;
}

TEST(SortedValues, EqualsAComparisonSort) {
  auto values = normals(10007, 1);
  values[3] = -1e30f;
  values[4] = 1e30f;
  values[5] = 1e-42f;  // subnormal
  values[6] = -1e-42f;
  values[7] = -0.0f;
  EXPECT_THAT(sorted_values(values), Pointwise(FloatEq(), std_sorted(values)));
  EXPECT_TRUE(sorted_values({}).empty());
}

TEST(MatchValues, SameCountGivesTheExemplarsValuesInTheImagesOrder) {
  auto values = normals(5000, 1);
  const auto before = values;
  const auto exemplar = std_sorted(normals(5000, 2));
  match_values(values, exemplar);
  EXPECT_EQ(std_sorted(values), exemplar);
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto i, auto j) { return before[i] < before[j]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    ASSERT_EQ(values[order[rank]], exemplar[rank]);
}

TEST(MatchValues, IsTheIdentityOnItsOwnHistogram) {
  auto values = normals(999, 3);
  const auto before = values;
  match_values(values, sorted_values(values));
  EXPECT_EQ(values, before);
}

TEST(MatchValues, TiesKeepTheirOrder) {
  std::vector<float> values{1, 0, 1, 0, -0.0f, 1};
  const std::vector<float> exemplar{10, 20, 30, 40, 50, 60};
  match_values(values, exemplar);
  EXPECT_THAT(values, ElementsAre(40, 10, 50, 20, 30, 60));
}

TEST(MatchValues, InterpolatesQuantilesBetweenSizes) {
  std::vector<float> more{3, 1, 2, 0};
  match_values(more, std::vector<float>{0, 1});
  EXPECT_THAT(more, ElementsAre(1.0f, 0.25f, 0.75f, 0.0f));
  std::vector<float> fewer{5, 4};
  match_values(fewer, std::vector<float>{0, 1, 2, 3});
  EXPECT_THAT(fewer, ElementsAre(2.5f, 0.5f));
  std::vector<float> flat{7, 7, 7};
  match_values(flat, std::vector<float>{2});
  EXPECT_THAT(flat, ElementsAre(2, 2, 2));
}

TEST(MatchValues, KeepsMomentsBetweenSizes) {
  const auto exemplar = std_sorted(normals(4001, 4));
  auto values = normals(30011, 5);
  match_values(values, exemplar);
  const auto mean = [](const std::vector<float>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  EXPECT_NEAR(mean(values), mean(exemplar), 1e-3);
  const auto square = [](std::vector<float> v) {
    for (float& x : v) x *= x;
    return v;
  };
  EXPECT_NEAR(mean(square(values)), mean(square(exemplar)), 2e-3);
  EXPECT_THROW(match_values(values, {}), Error);
}

TEST(MatchHistogram, EachChannelOnItsOwnForAnyThreads) {
  Image image(40, 30, 5), exemplar(17, 23, 5);
  Random random(6);
  for (float& v : image.pixels) v = random.normal();
  for (float& v : exemplar.pixels) v = std::exp(random.normal());
  std::vector<Image> results;
  for (const int threads : {1, 2, 8}) {
    set_thread_count(threads);
    results.push_back(image);
    match_histogram(results.back(), exemplar);
  }
  set_thread_count(0);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
  for (int c = 0; c < 5; ++c) {
    auto expected = extract_channels(image, c, 1).pixels;
    match_values(expected, sorted_values(extract_channels(exemplar, c, 1).pixels));
    EXPECT_EQ(extract_channels(results[0], c, 1).pixels, expected);
  }
  EXPECT_THROW(match_histogram(image, Image(4, 4, 3)), Error);
}

}  // namespace
}  // namespace gramloom
