#include "neural/resample.h"

#include <gtest/gtest.h>

#include "tensors.h"

namespace gramloom::neural {
namespace {

TEST(Resample, AConstantStaysConstant) {
  const at::Tensor flat = at::full({2, 7, 9}, 0.3f);
  for (const Size size : {Size{14, 18}, Size{3, 2}, Size{9, 20}, Size{1, 1}})
    EXPECT_LT((resample(flat, size, Tile::x) - 0.3f).abs().max().item<double>(), 1e-6);
}

TEST(Resample, TheSameSizeIsTheSamePicture) {
  const at::Tensor planes = numbers({3, 5, 6}, 1);
  EXPECT_TRUE(at::equal(resample(planes, {6, 5}, Tile::both), planes));
}

TEST(Resample, WrappedPicturesCommuteWithShifts) {
  const at::Tensor planes = numbers({1, 8, 8}, 2);
  const at::Tensor a = resample(at::roll(planes, {3, 2}, {1, 2}), {16, 16}, Tile::both);
  const at::Tensor b = at::roll(resample(planes, {16, 16}, Tile::both), {6, 4}, {1, 2});
  EXPECT_LT(relative_difference(a, b), 1e-5);
}

TEST(Resample, GradientIsTheAdjoint) {
  for (const Tile tile : {Tile::none, Tile::x, Tile::both})
    for (const Size size : {Size{4, 3}, Size{5, 9}, Size{13, 14}}) {
      const at::Tensor a = numbers({2, 7, 8}, 3, at::kDouble).requires_grad_(true);
      const at::Tensor out = resample(a, size, tile);
      const at::Tensor b = numbers(out.sizes(), 4, at::kDouble);
      (out * b).sum().backward();
      EXPECT_NEAR((a.detach() * a.grad()).sum().item<double>(),
                  (out.detach() * b).sum().item<double>(), 1e-10);
    }
}

TEST(Resample, EnlargesALineExactlyInside) {  // Keys' cubic reproduces polynomials of degree 2
  const at::Tensor x = at::arange(16, at::kFloat);
  const at::Tensor line = resample((x * x).view({1, 1, 16}), {32, 1}, Tile::none).view({32});
  for (int i = 8; i < 24; ++i) {
    const double at_x = (i + 0.5) / 2 - 0.5;
    EXPECT_NEAR(line[i].item<double>(), at_x * at_x, 1e-4);
  }
}

}  // namespace
}  // namespace gramloom::neural
