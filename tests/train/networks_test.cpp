#include "train/networks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "train/patch_loss.h"

namespace gramloom::train {
namespace {

// The derivative of `loss` by some of each parameter's numbers, against differences, in double.
template <class Loss>
void expect_gradients(torch::nn::Module& module, Loss&& loss) {
  module.zero_grad();
  loss().backward();
  for (const auto& item : module.named_parameters()) {
    at::Tensor value = item.value();
    ASSERT_TRUE(value.grad().defined()) << item.key();
    const at::Tensor flat = value.detach().view(-1), gradient = value.grad().reshape(-1);
    const torch::NoGradGuard no_gradients;
    for (std::int64_t i = 0; i < flat.numel(); i += std::max<std::int64_t>(1, flat.numel() / 3)) {
      const double step = 1e-6, before = flat[i].item<double>();
      flat[i] = before + step;
      const double above = loss().template item<double>();
      flat[i] = before - step;
      const double below = loss().template item<double>();
      flat[i] = before;
      const double expected = (above - below) / (2 * step);
      EXPECT_NEAR(gradient[i].item<double>(), expected, 1e-5 * (1 + std::abs(expected)))
          << item.key() << "[" << i << "]";
    }
  }
}

GeneratorDescription two_levels(int materials) {
  GeneratorDescription description;
  description.levels = {{4, 8, 3}, {4, 8, 2}};
  description.materials.resize(static_cast<std::size_t>(materials));
  return description;
}

TEST(Networks, GradientsOfALevelAreItsDerivatives) {
  torch::manual_seed(1);
  for (const int materials : {1, 3})
    for (const int level : {0, 1}) {
      LevelNet net(two_levels(materials), level);
      net->to(at::kDouble);
      const auto options = at::TensorOptions().dtype(at::kDouble);
      const at::Tensor coarser = level == 0 ? at::Tensor() : at::randn({2, 3, 10, 12}, options);
      const at::Tensor noise = at::randn({2, 4, 10, 12}, options);
      const at::Tensor shares = at::rand({materials}, options);
      for (const Border border : {Border::wraps, Border::mirrors})
        expect_gradients(*net,
                         [&] { return net->forward(coarser, noise, shares, border).pow(2).sum(); });
    }
}

TEST(Networks, GradientsOfTheDiscriminatorAreItsDerivatives) {
  torch::manual_seed(2);
  Discriminator discriminator(3, 6, 2);
  discriminator->to(at::kDouble);
  discriminator->eval();  // the singular vectors stay
  const at::Tensor picture = at::randn({2, 3, 12, 11}, at::kDouble);
  for (const bool wraps : {true, false})
    expect_gradients(*discriminator,
                     [&] { return discriminator->forward(picture, wraps).pow(2).sum(); });
}

TEST(Networks, NormalisedWeightsHaveALargestSingularValueOfOne) {
  torch::manual_seed(3);
  NormalisedConvolution convolution(5, 7, 1);
  for (int i = 0; i < 50; ++i) convolution->forward(at::randn({1, 5, 4, 4}));
  const at::Tensor matrix = convolution->weight.detach().flatten(1);
  const at::Tensor input = at::eye(5).view({5, 5, 1, 1});
  const torch::NoGradGuard no_gradients;
  const at::Tensor normalised =
      convolution->forward(input).view({5, 7}) - convolution->bias.view({1, 7});
  EXPECT_NEAR(at::linalg_svdvals(normalised)[0].item<float>(), 1, 1e-3);
}

TEST(Networks, UpsamplingKeepsAPlane) {
  const at::Tensor x = at::arange(8, at::kFloat).view({1, 1, 1, 8}).expand({1, 1, 8, 8});
  const at::Tensor large = upsampled(x.contiguous(), Border::mirrors);
  ASSERT_EQ(large.size(3), 16);
  for (int i = 2; i < 14; ++i)
    EXPECT_NEAR(large[0][0][5][i].item<float>(), (i + 0.5) / 2 - 0.5, 1e-5);
}

TEST(PatchLoss, ValuesOfTheSameRank) {
  const at::Tensor values = torch::tensor({{3.0f, 1.0f, 2.0f}, {0.0f, -5.0f, 9.0f}});
  const at::Tensor target = torch::tensor({{30.0f, 10.0f, 20.0f}, {1.0f, 3.0f, 2.0f}});
  const at::Tensor expected = torch::tensor({{30.0f, 10.0f, 20.0f}, {2.0f, 1.0f, 3.0f}});
  EXPECT_TRUE(at::equal(of_same_rank(values, target), expected));
  // Of twice as many, ranks lie between.
  const at::Tensor more = torch::tensor({{0.0f, 1.0f, 2.0f, 3.0f}});
  const at::Tensor matched = of_same_rank(more, torch::tensor({{0.0f, 10.0f}}));
  EXPECT_TRUE(at::allclose(matched, torch::tensor({{0.0f, 2.5f, 7.5f, 10.0f}})));
}

TEST(PatchLoss, OfAPictureToItselfIsZeroAndGrowsWithAChange) {
  torch::manual_seed(4);
  const at::Tensor picture = at::randn({1, 3, 24, 24});
  EXPECT_NEAR(sliced_distance(picture, picture, 16, 5, false).item<float>(), 0, 1e-8);
  const float little = sliced_distance(1.1 * picture, picture, 64, 5, false).item<float>();
  const float more = sliced_distance(1.5 * picture, picture, 64, 5, false).item<float>();
  // A factor of f moves every projection of variance 1 by f − 1.
  EXPECT_NEAR(little, 0.01, 0.004);
  EXPECT_NEAR(more, 0.25, 0.1);
}

TEST(PatchLoss, GradientsAreItsDerivatives) {
  torch::manual_seed(5);
  const at::Tensor exemplar = at::randn({1, 2, 16, 16}, at::kDouble);
  at::Tensor picture = at::randn({1, 2, 12, 12}, at::kDouble).requires_grad_(true);
  const auto loss = [&] {
    torch::manual_seed(6);  // the same directions
    return sliced_distance(picture, exemplar, 4, 3, true);
  };
  loss().backward();
  const at::Tensor gradient = picture.grad().reshape(-1), flat = picture.detach().view(-1);
  const torch::NoGradGuard no_gradients;
  for (std::int64_t i = 0; i < flat.numel(); i += 37) {
    const double before = flat[i].item<double>(), step = 1e-5;
    flat[i] = before + step;
    const double above = loss().item<double>();
    flat[i] = before - step;
    const double below = loss().item<double>();
    flat[i] = before;
    EXPECT_NEAR(gradient[i].item<double>(), (above - below) / (2 * step), 2e-4);
  }
}

}  // namespace
}  // namespace gramloom::train
