#include "runs/benchmark.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.h"

namespace gramloom {
namespace {

// t(0.975) of two degrees of freedom: 0.95 √(2 / (1 − 0.95²)).
const double t2 = 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95));

TEST(MeanInterval, QuantilesAreThoseOfTables) {
  const std::vector<std::pair<int, double>> table{{1, 12.7062}, {2, 4.3027},  {3, 3.1824},
                                                  {4, 2.7764},  {9, 2.2622},  {16, 2.1199},
                                                  {30, 2.0423}, {120, 1.9799}};
  for (const auto& [degrees, t] : table) EXPECT_NEAR(student_quantile(0.975, degrees), t, 5e-5);
  EXPECT_NEAR(student_quantile(0.95, 5), 2.0150, 5e-5);
  EXPECT_NEAR(student_quantile(0.5, 7), 0, 1e-12);
  EXPECT_NEAR(student_quantile(0.975, 2), t2, 1e-12);
}

TEST(MeanInterval, OfThreeValuesIsTheClosedForm) {
  const MeanInterval interval = mean_interval(std::array{1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(interval.mean, 2);
  EXPECT_NEAR(interval.half_width.value(), t2 / std::sqrt(3), 1e-12);
  EXPECT_EQ(interval.count, 3);
}

TEST(MeanInterval, OneValueHasNone) {
  EXPECT_EQ(mean_interval(std::array{0.5}), (MeanInterval{0.5, std::nullopt, 1}));
}

ScoreRow job(const std::string& exemplar, const std::string& method, int seed, double likeness,
             double seam_x = 0, double seam_y = 0) {
  return {exemplar, method, "kind", seed, Status::done, 2.0 * seed, {}, {likeness, seam_x, seam_y}};
}

const std::vector<BenchmarkColumn> columns{
    {"likeness", {"likeness"}, true}, {"seam", {"seam_x", "seam_y"}}, {"seconds", {"seconds"}}};

ScoreSheet sheet_of(std::vector<ScoreRow> rows) {
  return {{"likeness", "seam_x", "seam_y"}, std::move(rows)};
}

TEST(Benchmark, ExemplarsCountAndNotTheirSeeds) {
  const auto rows = benchmark_rows(sheet_of({job("a", "m", 1, 1), job("a", "m", 2, 3),
                                             job("b", "m", 1, 4), job("c", "m", 1, 6)}),
                                   columns);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].exemplars, 3);
  EXPECT_DOUBLE_EQ(rows[0].values[0]->mean, 4);  // of 2, 4 and 6
  EXPECT_NEAR(rows[0].values[0]->half_width.value(), t2 * 2 / std::sqrt(3), 1e-12);
  EXPECT_EQ(rows[0].values[0]->count, 3);
  EXPECT_DOUBLE_EQ(rows[0].values[2]->mean, (3 + 2 + 2) / 3.0);
}

TEST(Benchmark, TheWorseSeamCounts) {
  ScoreRow one_axis = job("b", "m", 1, 1, 0.25);
  one_axis.scores[2] = std::nullopt;
  const auto rows = benchmark_rows(sheet_of({job("a", "m", 1, 1, 0.5, 0.75), one_axis}), columns);
  EXPECT_DOUBLE_EQ(rows[0].values[1]->mean, 0.5);
}

TEST(Benchmark, WhatIsNotDoneOrHasNoScoreIsLeftOut) {
  ScoreRow failed = job("a", "m", 1, 100);
  failed.status = Status::failed;
  ScoreRow undefined = job("b", "m", 1, 0);
  undefined.scores[0] = std::nullopt;
  ScoreRow nothing = job("a", "n", 1, 1);
  nothing.status = Status::interrupted;
  const auto rows =
      benchmark_rows(sheet_of({failed, nothing, undefined, job("c", "m", 1, 2)}), columns);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].values[0], (MeanInterval{2, std::nullopt, 1}));
  EXPECT_EQ(rows[0].exemplars, 2);  // b has seams and seconds
}

TEST(Benchmark, DifferencesArePairedByExemplar) {
  const auto rows =
      benchmark_rows(sheet_of({job("a", "m", 1, 0.1), job("a", "n", 1, 0.3), job("b", "m", 1, 0.8),
                               job("b", "n", 1, 1.0), job("c", "n", 1, 77)}),
                     columns, "m");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_DOUBLE_EQ(rows[0].values[0]->mean, 0.45);
  EXPECT_NEAR(rows[1].values[0]->mean, 0.2, 1e-12);
  EXPECT_NEAR(rows[1].values[0]->half_width.value(), 0, 1e-12);
  EXPECT_EQ(rows[1].exemplars, 2);
}

TEST(Benchmark, TheMethodToCompareWithMustBeThere) {
  try {
    benchmark_rows(sheet_of({job("a", "m", 1, 1)}), columns, "k");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "there is no method 'k', only m");
  }
}

}  // namespace
}  // namespace gramloom
