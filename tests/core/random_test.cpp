#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace gramloom {
namespace {

TEST(Philox, MatchesThePublishedVectors) {
  // Random123's known-answer tests for philox4x32-10.
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, DependsOnSeedStreamAndPlaceAlone) {
  Random a(7, 3), b(7, 3), other_seed(8, 3), other_stream(7, 4);
  for (int i = 0; i < 100; ++i) {
    const auto bits = a.bits();
    EXPECT_EQ(bits, b.bits());
    EXPECT_NE(bits, other_seed.bits());
    EXPECT_NE(bits, other_stream.bits());
  }
}

TEST(Random, ManyAtOnceAreTheSame) {
  for (const std::size_t before : {0, 1, 3, 4})
    for (const std::size_t count : {0, 1, 5, 127, 128, 129, 1000}) {
      Random one(9, 4), many(9, 4);
      for (std::size_t i = 0; i < before; ++i) EXPECT_EQ(one.bits(), many.bits());
      std::vector<std::uint32_t> words(count);
      many.fill(words);
      for (const std::uint32_t word : words) ASSERT_EQ(word, one.bits()) << before << " " << count;
      EXPECT_EQ(one.bits(), many.bits());
    }
}

TEST(Random, SplittingDoesNotAdvanceTheParent) {
  Random parent(1), untouched(1);
  std::set<std::uint32_t> first;
  for (std::uint64_t part = 0; part < 1000; ++part) first.insert(parent.stream(part).bits());
  EXPECT_GT(first.size(), 998u);  // two of 1000 draws of 32 bits coincide once in 8000 runs
  EXPECT_EQ(parent.bits(), untouched.bits());
}

TEST(Random, UniformMomentsAndBounds) {
  Random random(11);
  const int count = 200000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const float u = random.uniform();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    sum += u;
    squares += static_cast<double>(u) * u;
  }
  EXPECT_NEAR(sum / count, 1.0 / 2, 0.005);
  EXPECT_NEAR(squares / count, 1.0 / 3, 0.005);
}

TEST(Random, BelowIsUniform) {
  Random random(5);
  std::vector<int> counts(7);
  const int count = 140000;
  for (int i = 0; i < count; ++i) ++counts.at(random.below(7));
  double chi2 = 0;
  for (const int n : counts) chi2 += std::pow(n - count / 7.0, 2) / (count / 7.0);
  EXPECT_LT(chi2, 22.5);  // 0.1 % of chi-square with 6 degrees of freedom
}

TEST(Random, NormalMomentsAndTails) {
  Random random(3);
  const int count = 400000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  int beyond_two = 0;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    ASSERT_TRUE(std::isfinite(x));
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
    beyond_two += std::abs(x) > 2;
  }
  EXPECT_NEAR(m1 / count, 0, 0.01);
  EXPECT_NEAR(m2 / count, 1, 0.015);
  EXPECT_NEAR(m3 / count, 0, 0.03);
  EXPECT_NEAR(m4 / count, 3, 0.1);
  EXPECT_NEAR(static_cast<double>(beyond_two) / count, 0.0455, 0.002);
}

}  // namespace
}  // namespace gramloom
