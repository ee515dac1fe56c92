#include "neural/loss/sliced.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/threads.h"
#include "neural/loss/patches.h"
#include "neural/loss/wasserstein.h"
#include "tensors.h"
#include "terms.h"

namespace gramloom::neural {
namespace {

constexpr int every_position = 1 << 30;  // positions; a part of them: sampled_test.cpp

struct WholeTerm : MadeTerm {
  WholeTerm(const at::Tensor& exemplar, Size target, Tile wraps, std::vector<int> patch_sizes,
            int directions, Random random)
      : MadeTerm(SlicedParams{1, std::move(patch_sizes), every_position}, exemplar, target, wraps,
                 directions, random) {}
};

WholeTerm term_for(const at::Tensor& exemplar, Size target, Tile wraps,
                   std::vector<int> patch_sizes = {5}, int directions = 8) {
  return {exemplar, target, wraps, std::move(patch_sizes), directions, Random(7)};
}

double value(const WholeTerm& term, const at::Tensor& picture, std::uint64_t step = 0) {
  return term.value(picture, step);
}

std::string complaint(const at::Tensor& exemplar, Size target, Tile wraps, int patch_size) {
  try {
    term_for(exemplar, target, wraps, {patch_size});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Sliced, ZeroForTheExemplarItself) {
  const at::Tensor exemplar = numbers({3, 20, 26}, 1);
  const WholeTerm term = term_for(exemplar, size_of(exemplar), Tile::none, {5, 3});
  for (std::uint64_t step = 0; step < 4; ++step) {
    at::Tensor gradient = at::zeros_like(exemplar);
    EXPECT_EQ(term.add(exemplar, 1, step, gradient), 0);
    EXPECT_EQ(gradient.abs().max().item<float>(), 0);
  }
}

TEST(Sliced, ZeroForShiftsOfAPeriodicExemplar) {
  // The exemplar has all 6 × 8 patches of a period four times; so has each shift of it on the
  // torus.
  const at::Tensor period = numbers({2, 6, 8}, 1);
  const at::Tensor torus = period.repeat({1, 2, 2});
  const at::Tensor exemplar = period.repeat({1, 3, 3}).narrow(1, 0, 16).narrow(2, 0, 20);
  const WholeTerm term = term_for(exemplar.contiguous(), size_of(torus), Tile::both);
  for (const std::int64_t shift : {0, 1, 5})
    for (std::uint64_t step = 0; step < 3; ++step)
      EXPECT_LT(value(term, at::roll(torus, {shift, 2 * shift}, {1, 2}).contiguous(), step), 1e-6);
  EXPECT_GT(value(term, numbers(torus.sizes(), 2)), 0.02);
}

TEST(Sliced, AboutOneForNoStructureAtAll) {
  const at::Tensor exemplar = numbers({3, 40, 40}, 1);
  const WholeTerm term = term_for(exemplar, {40, 40}, Tile::both, {5}, 64);
  const at::Tensor flat = exemplar.mean({1, 2}, true).expand_as(exemplar).contiguous();
  EXPECT_NEAR(value(term, flat), 1, 0.02);  // step 0 has the directions that it is divided for
  EXPECT_NEAR(value(term, flat, 1), 1, 0.2);
}

TEST(Sliced, StepsHaveDirectionsOfTheirOwn) {
  const at::Tensor exemplar = numbers({2, 20, 20}, 1), picture = numbers({2, 20, 20}, 2);
  const WholeTerm term = term_for(exemplar, {20, 20}, Tile::both);
  EXPECT_EQ(value(term, picture, 3), value(term, picture, 3));
  EXPECT_EQ(value(term, picture, 3), value(term_for(exemplar, {20, 20}, Tile::both), picture, 3));
  EXPECT_NE(value(term, picture, 3), value(term, picture, 4));
  const WholeTerm other(exemplar, {20, 20}, Tile::both, {5}, 8, Random(8));
  EXPECT_NE(value(term, picture, 3), value(other, picture, 3));
}

// A step's unit filters, drawn as sliced.cpp draws them.
at::Tensor filters(std::int64_t directions, std::int64_t channels, std::int64_t side,
                   std::uint64_t step) {
  Random random = Random(7).stream(step);
  at::Tensor result = at::empty({directions, channels, side, side}, at::kFloat);
  for (std::int64_t i = 0; i < result.numel(); ++i) result.data_ptr<float>()[i] = random.normal();
  return result.div_(result.flatten(1).norm(2, 1).view({-1, 1, 1, 1}));
}

TEST(Sliced, IsTheDistanceOfPatchesAlongAllDirections) {
  // The large picture is compared along few directions at a time.
  const at::Tensor exemplar = numbers({1, 30, 40}, 1);
  const std::int64_t positions = 1300 * 1300, directions = 11;
  ASSERT_LT(sliced_values_at_once / positions, directions);
  ASSERT_NE(directions % (sliced_values_at_once / positions), 0);
  for (const std::int64_t side : {36, 1300}) {
    const at::Tensor picture = numbers({1, side, side}, 2);
    const WholeTerm term = term_for(exemplar, size_of(picture), Tile::both, {3}, directions);
    at::Tensor gradient = at::zeros_like(picture), expected = at::zeros_like(picture);
    const double found = term.add(picture, 2, 5, gradient);

    const auto projected = [&](std::uint64_t step) {
      return project_patches(exemplar, filters(directions, 1, 3, step), Tile::none);
    };
    const double flat = (projected(0) - projected(0).mean(1, true)).abs().mean().item<double>();
    at::Tensor values = project_patches(picture, filters(directions, 1, 3, 5), Tile::both);
    const at::Tensor goal = std::get<0>(projected(5).sort(1)).contiguous();
    EXPECT_NEAR(found, wasserstein(values, goal) / flat, 1e-6 * found);
    spread_patches(values * (2 / flat), filters(directions, 1, 3, 5), Tile::both, expected);
    EXPECT_LT(relative_difference(gradient, expected), 1e-5);
  }
}

TEST(Sliced, PatchSizesTakeTurns) {
  const at::Tensor exemplar = numbers({2, 20, 20}, 1), picture = numbers({2, 20, 20}, 2);
  const WholeTerm both = term_for(exemplar, {20, 20}, Tile::none, {5, 3});
  const WholeTerm large = term_for(exemplar, {20, 20}, Tile::none, {5});
  const WholeTerm small = term_for(exemplar, {20, 20}, Tile::none, {3});
  for (const std::uint64_t step : {0, 2, 4})
    EXPECT_EQ(value(both, picture, step), value(large, picture, step));
  // Each is divided by the exemplar's own distance in the first patch size.
  const double ratio = value(both, picture, 1) / value(small, picture, 1);
  for (const std::uint64_t step : {1, 3, 5})
    EXPECT_NEAR(value(both, picture, step) / value(small, picture, step), ratio, 1e-9);
}

TEST(Sliced, GradientMatchesFiniteDifferences) {
  for (const Tile wraps : {Tile::none, Tile::x, Tile::both})
    for (const Size size : {Size{14, 12}, Size{10, 21}}) {
      const at::Tensor exemplar = numbers({2, 12, 14}, 1);
      // Stronger than the exemplar: few values are near the ones that they go to, where W₁ bends.
      const at::Tensor picture = 3 * numbers({2, size.height, size.width}, 2);
      const WholeTerm term = term_for(exemplar, size, wraps, {3, 5});
      for (std::uint64_t step = 0; step < 2; ++step) {
        at::Tensor gradient = at::zeros_like(picture);
        term.add(picture, 1, step, gradient);
        for (std::uint64_t trial = 0; trial < 4; ++trial) {
          const at::Tensor direction = numbers(picture.sizes(), 10 + trial);
          const float h = 2e-4f;
          const double difference = (value(term, picture + h * direction, step) -
                                     value(term, picture - h * direction, step)) /
                                    (2 * h);
          EXPECT_NEAR((gradient * direction).sum().item<double>(), difference,
                      0.03 * gradient.norm().item<double>());
        }
      }
    }
}

TEST(Sliced, AddsItsWeightTimesTheGradient) {
  const at::Tensor exemplar = numbers({2, 20, 20}, 1), picture = numbers({2, 20, 20}, 2);
  const WholeTerm term = term_for(exemplar, {20, 20}, Tile::both);
  at::Tensor once = at::zeros_like(picture), more = picture.clone();
  const double value = term.add(picture, 1, 0, once);
  EXPECT_EQ(term.add(picture, 3, 0, more), value);
  EXPECT_LT(relative_difference(more, picture + 3 * once), 1e-5);
}

TEST(Sliced, OneThreadGivesTheBytesOfTwo) {
  const at::Tensor exemplar = numbers({2, 70, 60}, 1), picture = numbers({2, 90, 80}, 2);
  const WholeTerm term = term_for(exemplar, {80, 90}, Tile::x);
  at::Tensor gradient = at::zeros_like(picture), alone = at::zeros_like(picture);
  const double value = term.add(picture, 1, 0, gradient);
  set_thread_count(1);
  EXPECT_EQ(term.add(picture, 1, 0, alone), value);
  set_thread_count(0);
  EXPECT_TRUE(at::equal(gradient, alone));
}

TEST(Sliced, OfAFlatExemplarOnlyTheColourIsMatched) {
  // Of a colour whose mean over many patches may round to another one.
  const at::Tensor colour = at::tensor({0.1f, -0.7f, 0.3f}).view({3, 1, 1});
  const at::Tensor exemplar = colour.expand({3, 21, 19}).contiguous();
  const WholeTerm term = term_for(exemplar, {16, 16}, Tile::both);
  const at::Tensor goal = colour.expand({3, 16, 16}).contiguous();
  EXPECT_NEAR(value(term, goal), 0, 1e-12);
  EXPECT_NEAR(value(term, goal + 0.5f), 0.25, 1e-6);
  at::Tensor picture = numbers({3, 16, 16}, 1);
  for (int i = 0; i < 200; ++i) {
    at::Tensor gradient = at::zeros_like(picture);
    term.add(picture, 1, static_cast<std::uint64_t>(i), gradient);
    picture.sub_(gradient, static_cast<double>(picture.numel()) / 4);
  }
  EXPECT_LT((picture - goal).abs().max().item<double>(), 1e-5);
}

TEST(Sliced, PicturesSmallerThanAPatchAreAClearError) {
  const at::Tensor exemplar = numbers({1, 8, 12}, 1);
  EXPECT_EQ(complaint(exemplar, {12, 8}, Tile::none, 8), "");
  EXPECT_EQ(complaint(exemplar, {40, 40}, Tile::both, 9),
            "the exemplar of 12×8 is too small for patches of 9×9: make patch_sizes smaller");
  EXPECT_EQ(complaint(exemplar, {5, 9}, Tile::none, 7),
            "the texture of 5×9 is too small for patches of 7×7: make patch_sizes smaller");
  EXPECT_NE(complaint(exemplar, {5, 9}, Tile::y, 7), "");
  EXPECT_EQ(complaint(exemplar, {5, 9}, Tile::x, 7), "");  // it goes on beyond the edge
}

}  // namespace
}  // namespace gramloom::neural
