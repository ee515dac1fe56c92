// The terms of the loss that look at the picture itself; patches are in sliced_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "neural/loss/lags.h"
#include "tensors.h"
#include "terms.h"

namespace gramloom::neural {
namespace {

struct AutocorrelationTerm : MadeTerm {
  AutocorrelationTerm(const at::Tensor& exemplar, Size target, Tile wraps)
      : MadeTerm(AutocorrelationParams{}, exemplar, target, wraps) {}
};
struct SpectrumTerm : MadeTerm {
  SpectrumTerm(const at::Tensor& exemplar, Size target)
      : MadeTerm(SpectrumParams{}, exemplar, target, Tile::both) {}
};
struct VariationTerm : MadeTerm {
  VariationTerm(const at::Tensor& exemplar, Tile wraps)
      : MadeTerm(VariationParams{}, exemplar, size_of(exemplar), wraps) {}
};

double value(const MadeTerm& term, const at::Tensor& picture) { return term.value(picture); }

void expect_gradient_of_finite_differences(const MadeTerm& term, const at::Tensor& picture) {
  at::Tensor gradient = at::zeros_like(picture);
  const double own = term.add(picture, 1, 0, gradient);
  const double norm = gradient.norm().item<double>();
  ASSERT_GT(norm, 0);
  for (std::uint64_t trial = 0; trial < 4; ++trial) {
    const at::Tensor direction = numbers(picture.sizes(), 50 + trial, at::kDouble);
    const double h = 1e-6;
    const double difference =
        (value(term, picture + h * direction) - value(term, picture - h * direction)) / (2 * h);
    EXPECT_NEAR((gradient * direction).sum().item<double>(), difference, 1e-5 * norm);
  }
  at::Tensor more = picture.clone();  // the weight is the gradient's, which is added
  EXPECT_EQ(term.add(picture, 3, 0, more), own);
  EXPECT_LT(relative_difference(more, picture + 3 * gradient), 1e-12);
}

void expect_the_same_of_shifts(const MadeTerm& term, const at::Tensor& picture) {
  const double own = value(term, picture);
  ASSERT_GT(own, 1e-3);
  EXPECT_NEAR(value(term, at::roll(picture, {3, -4}, {1, 2})), own, 1e-9 * own);
}

double brute_force(const at::Tensor& planes, std::int64_t c, std::int64_t dy, std::int64_t dx,
                   Tile wraps) {
  const auto p = planes.accessor<double, 3>();
  const std::int64_t height = planes.size(1), width = planes.size(2);
  double sum = 0;
  int count = 0;
  for (std::int64_t y = 0; y < height; ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      std::int64_t to_y = y + dy, to_x = x + dx;
      if (tiles_y(wraps)) to_y = (to_y + height) % height;
      if (tiles_x(wraps)) to_x = (to_x + width) % width;
      if (to_y >= height || to_x < 0 || to_x >= width) continue;
      sum += p[c][y][x] * p[c][to_y][to_x];
      ++count;
    }
  return sum / count;
}

TEST(Autocorrelation, IsTheMeanProductWrittenOut) {
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both})
    for (const auto& [size, lags] : {std::pair{Size{7, 6}, Size{3, 2}},
                                     {Size{5, 8}, Size{1, 4}},
                                     {Size{9, 5}, Size{4, 1}},
                                     {Size{1, 1}, Size{1, 1}}}) {
      const at::Tensor planes = numbers({2, size.height, size.width}, 1, at::kDouble);
      const at::Tensor found = autocorrelation(planes, lags, wraps);
      ASSERT_EQ(found.sizes(), (at::IntArrayRef{2, lags.height, 2 * lags.width - 1}));
      for (std::int64_t c = 0; c < 2; ++c)
        for (std::int64_t dy = 0; dy < lags.height; ++dy)
          for (std::int64_t dx = -lags.width + 1; dx < lags.width; ++dx)
            EXPECT_NEAR(found[c][dy][dx + lags.width - 1].item<double>(),
                        brute_force(planes, c, dy, dx, wraps), 1e-12)
                << dy << ", " << dx << " of " << size.width << "×" << size.height;
    }
}

// Vertical stripes of −1 and 1 of that many pixels; products at a distance of dx are by hand.
at::Tensor stripes(std::int64_t height, std::int64_t width, std::int64_t half_period) {
  const at::Tensor x = at::arange(width, at::kDouble).div(static_cast<double>(half_period)).floor();
  return (1 - 2 * x.remainder(2)).view({1, 1, -1}).repeat({1, height, 1});
}

TEST(AutocorrelationTerm, KnownByHand) {
  // 8 × 8 has lags dy = 0, 1 and dx = −1, 0, 1. Stripes of 2: A = 1 at dx = 0. At ±1 on the
  // exemplar, 4 of 7 pairs are of one stripe: A = 1/7; on the torus, half of them: 0.
  const at::Tensor exemplar = stripes(8, 8, 2);
  const AutocorrelationTerm term(exemplar, {8, 8}, Tile::both);
  const double all = 4.0 / 49 + 1;  // of all lags but 0: ±1 in two rows, and (1, 0)
  EXPECT_NEAR(value(term, exemplar), 4.0 / 49 / all, 1e-9);
  EXPECT_NEAR(value(term, at::full({1, 8, 8}, 0.4, at::kDouble)), 1, 1e-9);
}

TEST(AutocorrelationTerm, ZeroAtTheExemplarItself) {
  for (const Size size : {Size{24, 20}, Size{17, 9}, Size{3, 40}}) {
    const at::Tensor exemplar = numbers({3, size.height, size.width}, 1, at::kDouble) + 2;
    EXPECT_NEAR(value(AutocorrelationTerm(exemplar, size, Tile::none), exemplar), 0, 1e-20);
  }
}

TEST(AutocorrelationTerm, ZeroForShiftsOfAPeriodicPicture) {
  // Its mean and, of a quarter of it, each product are those of a period.
  const at::Tensor period = numbers({2, 5, 6}, 1, at::kDouble);
  const at::Tensor torus = period.repeat({1, 8, 8});
  const AutocorrelationTerm term(torus, size_of(torus), Tile::both);
  // Not all pairs of the exemplar are of whole periods.
  const double own = value(term, torus);
  EXPECT_LT(own, 0.01);
  EXPECT_NEAR(value(term, at::roll(torus, {2, 3}, {1, 2})), own, 1e-12);
  EXPECT_GT(value(term, numbers(torus.sizes(), 2, at::kDouble)), 0.5);
}

TEST(AutocorrelationTerm, GradientMatchesFiniteDifferences) {
  const at::Tensor exemplar = numbers({2, 16, 20}, 1, at::kDouble);
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both})
    for (const Size size : {Size{20, 16}, Size{9, 21}})
      expect_gradient_of_finite_differences(AutocorrelationTerm(exemplar, size, wraps),
                                            numbers({2, size.height, size.width}, 2, at::kDouble));
}

TEST(AutocorrelationTerm, TheSameOfShiftsOnTheTorus) {
  expect_the_same_of_shifts(
      AutocorrelationTerm(numbers({2, 16, 20}, 1, at::kDouble), {12, 18}, Tile::both),
      numbers({2, 18, 12}, 2, at::kDouble));
}

TEST(SpectrumTerm, OneForNoStructureAtAll) {
  const at::Tensor exemplar = numbers({2, 16, 20}, 1, at::kDouble);
  EXPECT_NEAR(value(SpectrumTerm(exemplar, {30, 24}), at::full({2, 24, 30}, 0.4, at::kDouble)), 1,
              1e-3);
}

// Not quite nothing: the exemplar's autocorrelation is of what lies inside, and at lags that cut a
// period it is a little different from the torus's.
TEST(SpectrumTerm, NearNothingForAPeriodicExemplarItself) {
  for (const std::int64_t side : {32, 64}) {
    const at::Tensor wave = stripes(side, side, 4);
    const SpectrumTerm term(wave, size_of(wave));
    EXPECT_LT(value(term, wave), 0.05);
    EXPECT_GT(value(term, numbers({1, side, side}, 1, at::kDouble)), 0.5);
  }
}

TEST(SpectrumTerm, NoiseIsNearerToNoiseThanStripesAre) {
  // White noise of one deviation has the same spectrum everywhere.
  const SpectrumTerm term(numbers({1, 64, 64}, 1, at::kDouble), {64, 64});
  const double noise = value(term, numbers({1, 64, 64}, 2, at::kDouble));
  EXPECT_LT(noise, 0.4);
  EXPECT_GT(value(term, stripes(64, 64, 4)), 3 * noise);
}

TEST(SpectrumTerm, GradientMatchesFiniteDifferences) {
  const at::Tensor exemplar = numbers({2, 16, 20}, 1, at::kDouble);
  for (const Size size : {Size{20, 16}, Size{9, 21}, Size{15, 8}})
    expect_gradient_of_finite_differences(SpectrumTerm(exemplar, size),
                                          numbers({2, size.height, size.width}, 2, at::kDouble));
}

TEST(SpectrumTerm, TheSameOfShifts) {
  expect_the_same_of_shifts(SpectrumTerm(numbers({2, 16, 20}, 1, at::kDouble), {12, 18}),
                            numbers({2, 18, 12}, 2, at::kDouble));
}

TEST(VariationTerm, KnownByHand) {
  // Of 4 × 4 pixels 12 have a right neighbour that differs by 1; on the torus, 16 by 1 or 3.
  const at::Tensor ramp = at::arange(4, at::kDouble).view({1, 1, 4}).repeat({1, 4, 1});
  EXPECT_NEAR(value(VariationTerm(ramp, Tile::none), 3 * ramp), 4, 1e-3);  // (3 − 1)²
  EXPECT_NEAR(value(VariationTerm(ramp, Tile::y), ramp), 0, 1e-6);
  EXPECT_NEAR(value(VariationTerm(ramp, Tile::x), ramp), 1, 1e-3);  // (24/12 − 1)²
  EXPECT_NEAR(value(VariationTerm(ramp, Tile::x), at::zeros_like(ramp)), 1, 1e-3);
  // Along both axes: the gradient's length, not its parts' sum.
  const at::Tensor corner = at::zeros({1, 5, 5}, at::kDouble);
  corner[0][2][2] = 1;  // differences of −1 to the right and below, 1 from the left and above
  const at::Tensor two = at::zeros({1, 5, 5}, at::kDouble);
  two[0][2][2] = 1;
  two[0][0][4] = 1;  // 1 from the left, −1 below
  EXPECT_NEAR(value(VariationTerm(corner, Tile::none), two),
              std::pow((2 + std::sqrt(2) + 2) / (2 + std::sqrt(2)) - 1, 2), 1e-3);
}

TEST(VariationTerm, ZeroAtTheExemplarItself) {
  for (const Size size : {Size{24, 20}, Size{1, 9}}) {
    const at::Tensor exemplar = numbers({3, size.height, size.width}, 1, at::kDouble);
    EXPECT_NEAR(value(VariationTerm(exemplar, Tile::none), exemplar), 0, 1e-20);
  }
}

TEST(VariationTerm, AFlatChannelOfTheExemplarIsLeftOut) {
  at::Tensor exemplar = numbers({2, 12, 12}, 1, at::kDouble);
  exemplar[1].fill_(0.3);
  const VariationTerm term(exemplar, Tile::none);
  const at::Tensor picture = at::cat({exemplar.narrow(0, 0, 1), numbers({1, 12, 12}, 2)});
  EXPECT_NEAR(value(term, picture), 0, 1e-12);
  at::Tensor gradient = at::zeros_like(picture);
  term.add(at::zeros_like(picture), 1, 0, gradient);
  EXPECT_TRUE(gradient.isfinite().all().item<bool>());
}

TEST(VariationTerm, GradientMatchesFiniteDifferences) {
  const at::Tensor exemplar = numbers({2, 16, 20}, 1, at::kDouble);
  for (const Tile wraps : {Tile::none, Tile::x, Tile::y, Tile::both})
    expect_gradient_of_finite_differences(VariationTerm(exemplar, wraps),
                                          0.5 * numbers({2, 9, 13}, 2, at::kDouble));
}

TEST(VariationTerm, TheSameOfShiftsOnTheTorus) {
  expect_the_same_of_shifts(VariationTerm(numbers({2, 16, 20}, 1, at::kDouble), Tile::both),
                            0.5 * numbers({2, 18, 12}, 2, at::kDouble));
}

TEST(PictureTerms, FlatExemplarsGiveNumbers) {
  const at::Tensor flat = at::full({2, 12, 12}, 0.3), picture = numbers({2, 12, 12}, 1);
  const auto expect_numbers = [&](const auto& term) {
    for (const at::Tensor& x : {flat, picture}) {
      at::Tensor gradient = at::zeros_like(x);
      EXPECT_TRUE(std::isfinite(term.add(x, 1, 0, gradient)));
      EXPECT_TRUE(gradient.isfinite().all().item<bool>());
    }
  };
  expect_numbers(AutocorrelationTerm(flat, {12, 12}, Tile::both));
  expect_numbers(SpectrumTerm(flat, {12, 12}));
  expect_numbers(VariationTerm(flat, Tile::both));
}

}  // namespace
}  // namespace gramloom::neural
