// Moments of feature maps, and how Gram matrices are compared.
#include <gtest/gtest.h>

#include "neural/loss/gram_target.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

TEST(Moments, KnownByHand) {
  // Two maps at three positions: (1, 2, 3) and (0, 1, −1).
  const at::Tensor planes = at::tensor({1.0, 2.0, 3.0, 0.0, 1.0, -1.0}).view({2, 1, 3});
  const Moments m = moments(to_maps(planes.to(at::kDouble)));
  EXPECT_LT(relative_difference(m.gram * 3, at::tensor({14.0, -1.0, -1.0, 2.0}).view({2, 2})),
            1e-7);
  EXPECT_LT(relative_difference(m.mean, at::tensor({2.0, 0.0})), 1e-7);
}

TEST(Moments, SymmetricAndPositiveSemiDefinite) {
  const at::Tensor gram = moments(to_maps(numbers({24, 9, 7}, 1, at::kDouble))).gram;
  EXPECT_LT(relative_difference(gram, gram.t()), 1e-14);
  EXPECT_GT(std::get<0>(at::linalg_eigh(gram)).min().item<double>(), -1e-12);
}

TEST(Moments, UnchangedByShufflingPositions) {
  const at::Tensor planes = numbers({10, 6, 8}, 2, at::kDouble);
  const at::Tensor order = at::randperm(48);
  const at::Tensor shuffled = planes.reshape({10, 48}).index_select(1, order).reshape({10, 6, 8});
  const Moments a = moments(to_maps(planes)), b = moments(to_maps(shuffled));
  EXPECT_LT(relative_difference(a.gram, b.gram), 1e-12);
  EXPECT_LT(relative_difference(a.mean, b.mean), 1e-12);
}

TEST(Moments, AcrossScalesOfOneSizeAreThoseOfAllMapsTogether) {
  const at::Tensor a = numbers({5, 6, 8}, 1, at::kDouble), b = numbers({3, 6, 8}, 2, at::kDouble);
  const Moments across = moments({to_maps(a), to_maps(b)}, Tile::both);
  const Moments together = moments(to_maps(at::cat({a, b})));
  EXPECT_LT(relative_difference(across.gram, together.gram), 1e-12);
  EXPECT_LT(relative_difference(across.mean, together.mean), 1e-12);
}

TEST(Moments, AcrossScalesMeetAtTheCoarserPositions) {
  // A fine map of 4 positions that wraps, (1, 0, 0, 0), under triangles: its coarse positions 0 and
  // 1 get (1·3 + 0·3 + 0 + 0)/8 and (0·3 + 0·3 + 0 + 1)/8 of it.
  const at::Tensor fine = at::tensor({1.0, 0.0, 0.0, 0.0}, at::kDouble).view({1, 1, 4});
  const at::Tensor coarse = at::tensor({2.0, 5.0}, at::kDouble).view({1, 1, 2});
  const Moments m = moments({to_maps(fine), to_maps(coarse)}, Tile::x);
  EXPECT_NEAR(m.gram[0][1].item<double>(), (2 * 3.0 / 8 + 5 * 1.0 / 8) / 2, 1e-12);
  EXPECT_EQ(m.gram[0][1].item<double>(), m.gram[1][0].item<double>());
}

// E_l as Gatys, Ecker and Bethge write it: 1/(4 N² M²) Σ (G − Ĝ)² with G = F Fᵀ.
TEST(GramTarget, IsThePapersErrorWhenNothingIsAsked) {
  const at::Tensor f = numbers({5, 4, 6}, 3, at::kDouble), g = numbers({5, 4, 6}, 4, at::kDouble);
  const at::Tensor a = f.view({5, 24}), b = g.view({5, 24});
  const double expected =
      (at::mm(a, a.t()) - at::mm(b, b.t())).square().sum().item<double>() / (4.0 * 25 * 24 * 24);
  const GramTarget target(moments(to_maps(f)), {1, false, false, false, {}});
  EXPECT_NEAR(target.distance(moments(to_maps(g))).item<double>(), expected, 1e-12 * expected);
}

TEST(GramTarget, CentredAndStandardisedIsThatOfTheTransformedMaps) {
  const at::Tensor f = numbers({4, 5, 5}, 5, at::kDouble) * 3 + 2;
  const at::Tensor g = numbers({4, 5, 5}, 6, at::kDouble) + 1;
  const at::Tensor mean = f.mean({1, 2}, true), deviation = f.std({1, 2}, false, true);
  const auto with_constant = [&](const at::Tensor& maps) {
    const at::Tensor rows = ((maps - mean) / deviation).view({4, 25});
    const at::Tensor all = at::cat({rows, at::ones({1, 25}, at::kDouble)});
    return at::mm(all, all.t()) / 25;
  };
  const at::Tensor own = with_constant(f), other = with_constant(g);
  const double expected = (own - other).square().sum().item<double>() / (4 * 16);
  const GramTarget target(moments(to_maps(f)), {1, false, true, true, {}});
  EXPECT_NEAR(target.distance(moments(to_maps(g))).item<double>(), expected, 1e-9 * expected);
}

TEST(GramTarget, ZeroAtTheExemplarItselfAndOneAtNothing) {
  for (const bool centre : {false, true})
    for (const bool standardise : {false, true}) {
      const Moments m = moments(to_maps(numbers({8, 6, 6}, 7, at::kDouble)));
      const GramTarget target(m, {1, true, centre, standardise, {}});
      EXPECT_NEAR(target.distance(m).item<double>(), 0, 1e-20);
      // Maps that are flat at the exemplar's means (or zero) have no centred Gram matrix.
      const at::Tensor flat = centre ? m.mean : at::zeros_like(m.mean);
      EXPECT_NEAR(target.distance({at::outer(flat, flat), flat, {}}).item<double>(), 1, 1e-9);
    }
}

TEST(GramTarget, FlatMapsOfTheExemplarMakeNoInfinity) {
  const FeatureMaps flat = to_maps(at::full({3, 4, 4}, 2.0f));
  const GramTarget target(moments(flat), {1, true, true, true, {}});
  const double error = target.distance(moments(to_maps(numbers({3, 4, 4}, 8)))).item<double>();
  EXPECT_TRUE(std::isfinite(error));
}

at::Tensor products(const Moments& m, std::int64_t first, std::int64_t dy, std::int64_t dx) {
  for (const auto& shifted : m.shifted)
    if (shifted.first == first && shifted.dy == dy && shifted.dx == dx) return shifted.products;
  ADD_FAILURE() << "no products of maps from " << first << " on at " << dy << ", " << dx;
  return {};
}

TEST(ShiftedMoments, KnownByHand) {
  // Two maps at four positions in a square, f = 1 2 / 3 4 and g = 0 1 / 0 0.
  const at::Tensor planes =
      at::tensor({1.0, 2.0, 3.0, 4.0, 0.0, 1.0, 0.0, 0.0}, at::kDouble).view({2, 2, 2});
  const auto expect = [&](Tile tile, std::int64_t dy, std::int64_t dx, std::vector<double> values) {
    const Moments m = moments({to_maps(planes)}, tile, {1});
    ASSERT_EQ(m.shifted.size(), 4u);
    EXPECT_LT(relative_difference(products(m, 0, dy, dx), at::tensor(values).view({2, 2})), 1e-7);
  };
  // ff, f with g to the right, g with f to the right, gg.
  expect(Tile::none, 0, 1, {(1 * 2 + 3 * 4) / 2.0, 1 / 2.0, 0, 0});
  expect(Tile::none, 1, 0, {(1 * 3 + 2 * 4) / 2.0, 0, 4 / 2.0, 0});
  expect(Tile::none, 1, 1, {4, 0, 0, 0});
  expect(Tile::none, 1, -1, {6, 0, 3, 0});
  expect(Tile::x, 0, 1, {(2 + 2 + 12 + 12) / 4.0, 1 / 4.0, 1 / 4.0, 0});
  expect(Tile::y, 1, -1, {(2 * 3 + 4 * 1) / 2.0, 0, 3 / 2.0, 0});
  expect(Tile::both, 1, -1, {(1 * 4 + 2 * 3 + 3 * 2 + 4 * 1) / 4.0, 3 / 4.0, 3 / 4.0, 0});
}

TEST(ShiftedMoments, EachScaleWithItselfWhereItIsLargeEnough) {
  const Scales scales{to_maps(numbers({3, 8, 9}, 1)), to_maps(numbers({2, 4, 5}, 2))};
  const Moments m = moments(scales, Tile::both, {1, 2, 3, 5});
  EXPECT_EQ(m.shifted.size(), 4u * (3 + 2));  // 1, 2, 3 of the first, 1, 2 of the second
  EXPECT_EQ(products(m, 3, 2, -2).size(0), 2);
}

TEST(ShiftedMoments, UnchangedByShiftsOnTheTorus) {
  const at::Tensor planes = numbers({5, 7, 8}, 1, at::kDouble);
  const Moments a = moments({to_maps(planes)}, Tile::both, {2});
  const Moments b = moments({to_maps(at::roll(planes, {3, -2}, {1, 2}))}, Tile::both, {2});
  for (std::size_t i = 0; i < a.shifted.size(); ++i)
    EXPECT_LT(relative_difference(a.shifted[i].products, b.shifted[i].products), 1e-12);
}

TEST(GramTarget, ComparesShiftedProductsLikeTheOthers) {
  // Of one map, 1 2 / 3 4, on the torus: G = 7.5 and, at the four shifts, 7, 5.5, 5, 5.
  const at::Tensor map = at::tensor({1.0, 2.0, 3.0, 4.0}, at::kDouble).view({1, 2, 2});
  const auto of = [](const at::Tensor& planes) {
    return moments({to_maps(planes)}, Tile::both, {1});
  };
  const GramTarget plain(of(map), {1, false, false, false, {1}});
  const double squares = 7.5 * 7.5 + 7 * 7 + 5.5 * 5.5 + 5 * 5 + 5 * 5;
  EXPECT_NEAR(plain.distance(of(at::zeros_like(map))).item<double>(), squares / 4, 1e-9);
  EXPECT_NEAR(plain.distance(of(2 * map)).item<double>(), 9 * squares / 4, 1e-9);
  // Centred at 2.5: 1.25, and 0.75, −0.75, −1.25, −1.25; by the deviation, 1 and ±0.6, −1, −1.
  const GramTarget standardised(of(map), {1, false, true, true, {1}});
  EXPECT_NEAR(standardised.distance(of(at::full_like(map, 2.5))).item<double>(),
              (1 + 2 * 0.36 + 2) / 4, 1e-9);
  const GramTarget normalised(of(map), {1, true, true, true, {1}});
  EXPECT_NEAR(normalised.distance(of(at::full_like(map, 2.5))).item<double>(), 1, 1e-9);
}

TEST(GramTarget, WithShiftsZeroAtTheExemplarItselfAndItsShifts) {
  const at::Tensor planes = numbers({6, 9, 8}, 7, at::kDouble) + 1;
  for (const bool centre : {false, true}) {
    const auto of = [](const at::Tensor& p) { return moments({to_maps(p)}, Tile::both, {1, 3}); };
    const GramTarget target(of(planes), {1, true, centre, true, {1, 3}});
    EXPECT_NEAR(target.distance(of(planes)).item<double>(), 0, 1e-20);
    EXPECT_NEAR(target.distance(of(at::roll(planes, {2, 5}, {1, 2}))).item<double>(), 0, 1e-20);
    // The Gram matrix of maps shuffled alike is the same; what lies beside what is not.
    const at::Tensor shuffled =
        planes.view({6, 72}).index_select(1, at::arange(71, -1, -1)).view({6, 9, 8});
    EXPECT_GT(target.distance(of(shuffled)).item<double>(), 1e-3);
  }
}

}  // namespace
}  // namespace gramloom::neural
