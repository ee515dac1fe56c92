#include "neural/loss/wasserstein.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vector>

#include "core/threads.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

at::Tensor row(const std::vector<float>& values) {
  return at::tensor(values).view({1, static_cast<std::int64_t>(values.size())});
}

std::vector<float> floats_of(const at::Tensor& tensor) {
  const at::Tensor flat = tensor.contiguous();
  return {flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel()};
}

// Numbers of all sizes and both signs, many of them several times.
std::vector<float> awkward(std::size_t count) {
  const float tiny = std::numeric_limits<float>::denorm_min();
  const std::vector<float> some{0.0f,    -0.0f,    tiny,    -tiny,   5 * tiny, -3 * tiny,
                                1.0f,    -1.0f,    1e30f,   -1e30f,  1e-30f,   -1e-30f,
                                FLT_MAX, -FLT_MAX, FLT_MIN, -FLT_MIN};
  std::vector<float> values;
  Random random(4);
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(i % 2 ? random.normal() * 3
                           : some[random.below(static_cast<std::uint32_t>(some.size()))]);
  return values;
}

TEST(SortRows, SortsLikeTheLibraryAndKeepsEveryBit) {
  for (const std::size_t count : {1u, 2u, 3u, 100u, 5000u}) {
    std::vector<float> expected = awkward(count);
    at::Tensor sorted = row(expected);
    sort_rows(sorted);
    // −0 before 0, so that bits can be compared.
    std::sort(expected.begin(), expected.end(), [](float a, float b) {
      return a < b || (a == b && std::signbit(a) && !std::signbit(b));
    });
    const std::vector<float> found = floats_of(sorted);
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(found[i]), std::bit_cast<std::uint32_t>(expected[i]))
          << i << " of " << count << ": " << found[i] << ", not " << expected[i];
  }
}

TEST(SortRows, EachRowAlone) {
  at::Tensor rows = numbers({7, 301}, 1);
  const at::Tensor expected = std::get<0>(rows.sort(1));
  sort_rows(rows);
  EXPECT_TRUE(at::equal(rows, expected));
}

// The value of relative rank (i + ½)/count on the line through (j + ½)/n, sorted[j], level beyond
// its ends.
double interpolated(const std::vector<float>& sorted, double i, double count) {
  const auto n = static_cast<double>(sorted.size());
  const double at = (i + 0.5) / count;
  if (at <= 0.5 / n) return sorted.front();
  for (std::size_t j = 1; j < sorted.size(); ++j) {
    const double left = (static_cast<double>(j) - 0.5) / n, right = left + 1 / n;
    if (at <= right)
      return sorted[j - 1] + (at - left) / (right - left) * (sorted[j] - sorted[j - 1]);
  }
  return sorted.back();
}

double brute_force(const at::Tensor& rows, const at::Tensor& target) {
  double sum = 0;
  for (std::int64_t r = 0; r < rows.size(0); ++r) {
    std::vector<float> own = floats_of(rows[r]), goal = floats_of(target[r]);
    std::sort(own.begin(), own.end());
    std::sort(goal.begin(), goal.end());
    for (std::size_t i = 0; i < own.size(); ++i)
      sum += std::abs(own[i] -
                      interpolated(goal, static_cast<double>(i), static_cast<double>(own.size())));
  }
  return sum / static_cast<double>(rows.numel());
}

double distance(const at::Tensor& rows, const at::Tensor& target) {
  at::Tensor overwritten = rows.clone();
  return wasserstein(overwritten, target);
}

at::Tensor sorted(const at::Tensor& rows) { return std::get<0>(rows.sort(1)).contiguous(); }

TEST(Wasserstein, KnownByHand) {
  // 3 → 4, 1 → 0, 2 → 2.
  at::Tensor rows = row({3, 1, 2});
  EXPECT_DOUBLE_EQ(wasserstein(rows, row({0, 2, 4})), 2.0 / 3);
  EXPECT_TRUE(at::allclose(rows, row({-1.0f / 3, 1.0f / 3, 0})));
  // Relative ranks ¼, ¾ among those of 0, 2, 4, 6: half-way between the first and the last two.
  rows = row({5, 1});
  EXPECT_DOUBLE_EQ(wasserstein(rows, row({0, 2, 4, 6})), 0);
  // Ranks ⅛, ⅜, ⅝, ⅞ between 0 at ¼ and 4 at ¾: 0, 1, 3, 4.
  rows = row({0, 0, 0, 0});
  EXPECT_DOUBLE_EQ(wasserstein(rows, row({0, 4})), 2);
}

TEST(Wasserstein, IsWhatSortingGives) {
  for (const std::int64_t available : {400, 399, 401, 100, 1600, 37, 1}) {
    const at::Tensor rows = numbers({5, 400}, 1), target = sorted(numbers({5, available}, 2) + 0.3);
    const double expected = brute_force(rows, target);
    EXPECT_NEAR(distance(rows, target), expected, 1e-6 * expected) << available;
  }
}

TEST(Wasserstein, ZeroForTheSameValuesInAnyOrder) {
  const at::Tensor rows = numbers({3, 500}, 1);
  at::Tensor shuffled = rows.flip(1).contiguous();
  EXPECT_EQ(wasserstein(shuffled, sorted(rows)), 0);
  EXPECT_EQ(shuffled.abs().max().item<float>(), 0);  // and no slope
}

TEST(Wasserstein, AShiftOfAllValuesIsItsLength) {
  const at::Tensor rows = numbers({3, 500}, 1);
  EXPECT_NEAR(distance(rows + 0.25, sorted(rows)), 0.25, 1e-6);
  EXPECT_NEAR(distance(rows - 0.25, sorted(rows)), 0.25, 1e-6);
}

TEST(Wasserstein, GradientMatchesFiniteDifferences) {
  // Values on a grid of 1/16; what they are compared with is on one of 1/64, moved by 1/128: a step
  // of 1/256 meets no tie, and every difference is exact.
  for (const std::int64_t available : {60, 30}) {
    const at::Tensor rows = at::stack({at::randperm(60), at::randperm(60)}).to(at::kFloat) / 16;
    const at::Tensor target =
        sorted(at::round(numbers({2, available}, 2) * 16) / 16 + 2 + 1.0 / 128);
    at::Tensor gradient = rows.clone();
    wasserstein(gradient, target);
    ASSERT_GT(gradient.abs().max().item<float>(), 0);
    for (const std::int64_t i : {0, 1, 7, 59, 60, 61, 100, 119}) {
      at::Tensor more = rows.clone(), less = rows.clone();
      more.view(-1)[i] += 1.0f / 256;
      less.view(-1)[i] -= 1.0f / 256;
      const double difference = (distance(more, target) - distance(less, target)) * 128;
      EXPECT_NEAR(gradient.view(-1)[i].item<double>(), difference, 1e-8) << i;
    }
  }
}

TEST(Wasserstein, OneThreadGivesTheBytesOfTwo) {
  const at::Tensor target = sorted(numbers({9, 700}, 2));
  at::Tensor rows = numbers({9, 1000}, 1), alone = rows.clone();
  const double value = wasserstein(rows, target);
  set_thread_count(1);
  EXPECT_EQ(wasserstein(alone, target), value);
  set_thread_count(0);
  EXPECT_TRUE(at::equal(rows, alone));
}

}  // namespace
}  // namespace gramloom::neural
