// Of a large picture a step of the sliced distance counts a random part of the positions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/threads.h"
#include "neural/loss/patch_sample.h"
#include "neural/loss/patch_slopes.h"
#include "neural/loss/patches.h"
#include "neural/loss/potential.h"
#include "neural/loss/wasserstein.h"
#include "tensors.h"
#include "terms.h"

namespace gramloom::neural {
namespace {

struct SlicedTerm : MadeTerm {
  SlicedTerm(int positions, const at::Tensor& exemplar, Size target, Tile wraps = Tile::both)
      : MadeTerm(SlicedParams{1, {5, 3}, positions}, exemplar, target, wraps) {}
};

constexpr int all = 1 << 20;

// Noise with blobs of some pixels: patches that neighbour each other are alike.
at::Tensor blobs(at::IntArrayRef shape, std::uint64_t seed) {
  at::Tensor result = numbers(shape, seed);
  for (const std::int64_t axis : {1, 2})
    for (const std::int64_t shift : {1, 2})
      result = (result + at::roll(result, {shift}, {axis})).contiguous();
  return result.div_(result.std()).contiguous();
}

// 1 where a sample has a position.
at::Tensor covered(const PatchPositions& positions, const PatchSample& sample) {
  at::Tensor result = at::zeros({positions.rows, positions.columns});
  for (const PatchRun& run : sample.runs) result[run.y].narrow(0, run.x, run.length).add_(1);
  return result;
}

TEST(PatchSample, HasEachPositionOnceWhereThereAreFew) {
  const PatchPositions positions(at::zeros({2, 30, 150}), 5, Tile::x);
  const PatchSample sample(positions, 26 * 150, Random(1));
  EXPECT_EQ(sample.count, 26 * 150);
  EXPECT_TRUE(covered(positions, sample).eq(1).all().item<bool>());
}

TEST(PatchSample, HasEveryPositionAsOften) {
  const PatchPositions positions(at::zeros({1, 23, 150}), 3, Tile::both);  // 23 = 4 · 5 + 3
  const int draws = 4000;
  at::Tensor sum = at::zeros({23, 150});
  for (int i = 0; i < draws; ++i) {
    const PatchSample sample(positions, 23 * 150 / 5, Random(1).stream(i));
    const at::Tensor own = covered(positions, sample);
    EXPECT_EQ(own.sum().item<std::int64_t>(), sample.count);
    sum += own;
  }
  const double expected = draws / 5.0, deviation = std::sqrt(expected * (1 - 1 / 5.0));
  EXPECT_LT((sum - expected).abs().max().item<double>(), 5 * deviation);
  EXPECT_NEAR(sum.mean().item<double>(), expected, deviation / 4);
}

TEST(PatchSample, IsOfTheSamePlacesInPicturesOfOneSize) {
  const PatchPositions positions(at::zeros({1, 40, 100}), 3, Tile::both);
  const PatchSample once(positions, 500, Random(3)), again(positions, 500, Random(3)),
      other(positions, 500, Random(4));
  EXPECT_TRUE(at::equal(covered(positions, once), covered(positions, again)));
  EXPECT_FALSE(at::equal(covered(positions, once), covered(positions, other)));
}

TEST(PatchSample, IsProjectedAsAllPatchesAre) {
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both})
    for (const auto& [height, width] : {std::pair{40, 150}, {9, 70}, {5, 7}}) {
      const at::Tensor picture = numbers({3, height, width}, 1), filters = numbers({4, 3, 5, 5}, 2);
      const PatchPositions positions(picture, 5, wraps);
      const PatchSample sample(positions, positions.count() / 2 + 1, Random(1));
      const at::Tensor whole =
          project_patches(picture, filters, wraps).view({4, positions.rows, positions.columns});
      const at::Tensor found = project_sample(picture, filters, wraps, sample);
      ASSERT_EQ(found.size(1), sample.count);
      for (const PatchRun& run : sample.runs)
        EXPECT_LT(
            relative_difference(found.narrow(1, run.place, run.length),
                                whole.select(1, run.y).narrow(1, run.x, run.length).contiguous()),
            1e-5);
    }
}

// The mean over steps of what a step sees is that of the whole: the distribution along a direction.
TEST(PatchSample, DistributionsAreUnbiased) {
  const at::Tensor picture = blobs({2, 61, 130}, 1);
  const at::Tensor filters = numbers({1, 2, 5, 5}, 2) / std::sqrt(50);
  const at::Tensor whole = project_patches(picture, filters, Tile::both);
  const PatchPositions positions(picture, 5, Tile::both);
  const at::Tensor marks = at::linspace(-1.5, 1.5, 13);
  const auto below = [&](const at::Tensor& values) {
    return values.view({-1, 1}).lt(marks).to(at::kDouble).sum(0);
  };
  const int draws = 2000, part = 8;  // one row of eight
  at::Tensor sum = at::zeros({13}, at::kDouble), squares = at::zeros({13}, at::kDouble);
  for (int i = 0; i < draws; ++i) {
    const PatchSample sample(positions, positions.count() / part + 1, Random(1).stream(i));
    const at::Tensor own = below(project_sample(picture, filters, Tile::both, sample)) * part;
    sum += own;
    squares += own.square();
  }
  const at::Tensor mean = sum / draws;
  const at::Tensor error = (squares / draws - mean.square()).div(draws).sqrt();
  EXPECT_TRUE((mean - below(whole)).abs().le(4 * error + 1e-6).all().item<bool>())
      << mean << below(whole) << error;
}

std::span<float> values_of(at::Tensor& t) {
  return {t.data_ptr<float>(), static_cast<std::size_t>(t.numel())};
}

TEST(Potential, DistanceIsThatOfSortedValues) {
  at::Tensor goal = numbers({1, 3000}, 1);
  for (const double factor : {0.3, 1.0, 2.0})
    for (const double shift : {0.0, 0.5})
      for (const std::int64_t count : {700, 3000}) {
        at::Tensor values = factor * numbers({1, count}, 2) + shift;
        const double found = Potential(values_of(values), values_of(goal)).distance();
        at::Tensor sorted = goal.clone();
        sort_rows(sorted);
        EXPECT_NEAR(found, wasserstein(values, sorted), 0.01 * found + 2e-3);
      }
}

TEST(Potential, SlopesLeadToTheGoal) {
  at::Tensor values = 2 * numbers({2000}, 1) + 1, goal = numbers({1500}, 2);
  const Potential potential(values_of(values), values_of(goal));
  at::Tensor slopes = at::tensor({-4.0f, -2.0f, 1.5f, 6.0f, 1e30f, -1e30f});
  potential.to_slopes(values_of(slopes), 0.25f);
  EXPECT_TRUE(at::equal(slopes, at::tensor({-0.25f, -0.25f, 0.25f, 0.25f, 0.0f, 0.0f})));
}

TEST(Potential, EqualSamplesHaveNoSlope) {
  at::Tensor values = numbers({2000}, 1), constant = at::full({20}, 0.3f);
  for (at::Tensor sample : {values, constant}) {
    at::Tensor same = sample.flip(0).contiguous();
    const Potential potential(values_of(sample), values_of(same));
    EXPECT_EQ(potential.distance(), 0);
    potential.to_slopes(values_of(same), 1);
    EXPECT_EQ(same.abs().max().item<float>(), 0);
  }
}

TEST(PatchSlopes, AreWhatProjectingAndSpreadingGive) {
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both})
    for (const auto& [height, width] :
         {std::pair{40, 150}, {9, 2100}, {2100, 6}, {7, 7}, {11, 11}, {37, 300}}) {
      const at::Tensor picture = numbers({3, height, width}, 1), filters = numbers({4, 3, 5, 5}, 2);
      at::Tensor expected = numbers(picture.sizes(), 3), found = expected.clone();
      spread_patches(project_patches(picture, filters, wraps).square(), filters, wraps, expected);
      add_slopes(
          picture, filters, wraps,
          [](std::int64_t, std::span<float> products) {
            for (float& p : products) p *= p;
          },
          found);
      EXPECT_LT(relative_difference(found, expected), 1e-5) << height << "×" << width;
    }
  // Smaller than a patch: a patch sees a pixel several times.
  const at::Tensor picture = numbers({2, 2, 3}, 1), filters = numbers({3, 2, 7, 7}, 2);
  at::Tensor expected = at::zeros_like(picture), found = at::zeros_like(picture);
  spread_patches(project_patches(picture, filters, Tile::both), filters, Tile::both, expected);
  add_slopes(
      picture, filters, Tile::both, [](std::int64_t, std::span<float>) {}, found);
  EXPECT_LT(relative_difference(found, expected), 1e-5);
}

TEST(SlicedSample, ZeroForTheExemplarItself) {
  const at::Tensor exemplar = numbers({3, 30, 150}, 1);
  const SlicedTerm term(700, exemplar, size_of(exemplar), Tile::none);
  for (std::uint64_t step = 0; step < 4; ++step) {
    at::Tensor gradient = at::zeros_like(exemplar);
    EXPECT_EQ(term.add(exemplar, 1, step, gradient), 0);
    EXPECT_EQ(gradient.abs().max().item<float>(), 0);
  }
}

TEST(SlicedSample, RepeatsItsBytesWithAnyThreads) {
  const at::Tensor exemplar = blobs({2, 70, 160}, 1), picture = blobs({2, 90, 180}, 2);
  const SlicedTerm term(1500, exemplar, {180, 90}, Tile::x);
  at::Tensor gradient = at::zeros_like(picture), alone = at::zeros_like(picture),
             other = at::zeros_like(picture);
  const double value = term.add(picture, 1, 3, gradient);
  set_thread_count(1);
  EXPECT_EQ(term.add(picture, 1, 3, alone), value);
  set_thread_count(0);
  EXPECT_TRUE(at::equal(gradient, alone));
  EXPECT_NE(term.add(picture, 1, 5, other), value);
}

// Steps of the sample have the directions of those of the whole.
TEST(SlicedSample, GradientsHaveTheMeanOfTheWhole) {
  const at::Tensor exemplar = blobs({2, 70, 160}, 1), picture = 1.5 * blobs({2, 90, 180}, 2);
  const SlicedTerm whole(all, exemplar, {180, 90}), sampled(2000, exemplar, {180, 90});
  at::Tensor expected = at::zeros_like(picture), found = at::zeros_like(picture);
  double value = 0, of_whole = 0;
  std::uint64_t step = 0;
  const auto error_after = [&](std::uint64_t steps) {
    for (; step < steps; ++step) {
      value += sampled.add(picture, 1, step, found);
      of_whole += whole.add(picture, 1, step, expected);
    }
    return ((found - expected).norm() / expected.norm()).item<double>();
  };
  const double early = error_after(30), late = error_after(120);
  EXPECT_LT(late, 0.06);
  EXPECT_LT(late, 0.7 * early);  // as errors that are independent of each other do
  EXPECT_NEAR(value, of_whole, 0.03 * of_whole);
}

TEST(SlicedSample, GradientMatchesFiniteDifferencesOfTheWhole) {
  const at::Tensor exemplar = blobs({2, 70, 160}, 1), picture = 3 * blobs({2, 66, 150}, 2);
  for (const Tile wraps : {Tile::none, Tile::both}) {
    const SlicedTerm whole(all, exemplar, {150, 66}, wraps);
    const SlicedTerm sampled(3000, exemplar, {150, 66}, wraps);
    for (std::uint64_t step = 0; step < 2; ++step) {
      at::Tensor gradient = at::zeros_like(picture);
      sampled.add(picture, 1, step, gradient);
      for (std::uint64_t trial = 0; trial < 3; ++trial) {
        const at::Tensor direction =
            trial == 0 ? picture / 3 : blobs(picture.sizes(), 10 + trial) * picture.abs();
        const float h = 1e-2f;
        const double difference = (whole.value(picture + h * direction, step) -
                                   whole.value(picture - h * direction, step)) /
                                  (2 * h);
        EXPECT_NEAR((gradient * direction).sum().item<double>(), difference,
                    0.01 * (gradient.norm() * direction.norm()).item<double>());
      }
    }
  }
}

// A result of any size from an exemplar larger than the sample, whose pictures take the old way.
TEST(SlicedSample, OfTheExemplarAlone) {
  const at::Tensor exemplar = blobs({2, 120, 160}, 1), picture = 2 * blobs({2, 30, 40}, 2);
  const SlicedTerm whole(all, exemplar, {40, 30}), sampled(3000, exemplar, {40, 30});
  at::Tensor expected = at::zeros_like(picture), found = at::zeros_like(picture);
  const double value = whole.add(picture, 1, 0, expected);
  EXPECT_NEAR(sampled.add(picture, 1, 0, found), value, 0.05 * value);
  EXPECT_LT((found - expected).norm().item<double>(), 0.2 * expected.norm().item<double>());
}

}  // namespace
}  // namespace gramloom::neural
