#include "neural/network/convolution.h"

#include <gtest/gtest.h>

#include "tensors.h"

namespace gramloom::neural {
namespace {

struct Case {
  int inputs, outputs, kernel, dilation, height, width;
  Padding padding;
  bool planes, bias, relu;
};

// Σ w · x over the kernel, by the definition, in double.
at::Tensor plain_convolution(const at::Tensor& planes, const at::Tensor& weights,
                             const at::Tensor& bias, const Case& c) {
  const std::int64_t radius = (c.kernel - 1) / 2 * c.dilation;
  const at::Tensor padded = pad_planes(planes, radius, {c.padding, c.padding});
  const std::int64_t height = padded.size(1) - 2 * radius, width = padded.size(2) - 2 * radius;
  at::Tensor result = at::zeros({c.outputs, height, width}, at::kDouble);
  const auto in = padded.accessor<double, 3>();
  const auto w = weights.accessor<double, 4>();
  auto out = result.accessor<double, 3>();
  for (int o = 0; o < c.outputs; ++o)
    for (std::int64_t y = 0; y < height; ++y)
      for (std::int64_t x = 0; x < width; ++x) {
        double sum = c.bias ? bias[o].item<double>() : 0;
        for (int i = 0; i < c.inputs; ++i)
          for (int ky = 0; ky < c.kernel; ++ky)
            for (int kx = 0; kx < c.kernel; ++kx)
              sum += w[o][i][ky][kx] * in[i][y + ky * c.dilation][x + kx * c.dilation];
        out[o][y][x] = c.relu ? std::max(sum, 0.0) : sum;
      }
  return result;
}

class ConvolutionTest : public testing::TestWithParam<Case> {};

TEST_P(ConvolutionTest, EqualsThePlainLoopAndItsGradientTheDoubleOne) {
  const Case c = GetParam();
  const at::Tensor weights = numbers({c.outputs, c.inputs, c.kernel, c.kernel}, 1, at::kDouble);
  const at::Tensor bias = c.bias ? numbers({c.outputs}, 2, at::kDouble) : at::Tensor();
  const at::Tensor picture = numbers({c.inputs, c.height, c.width}, 3, at::kDouble);
  const Edges edges{c.padding, c.padding};

  const auto run = [&](at::ScalarType type) {
    const at::Tensor x = picture.to(type).clone().requires_grad_(true);
    const Convolution convolution(weights.to(type), c.bias ? bias.to(type) : bias, c.dilation);
    const FeatureMaps maps =
        c.planes ? convolution(x, edges, c.relu) : convolution(to_maps(x), edges, c.relu);
    EXPECT_EQ(maps.channels, c.outputs);
    const at::Tensor result = to_planes(maps);
    (result * numbers(result.sizes(), 4, type)).sum().backward();
    return std::pair(result.detach(), x.grad());
  };
  const auto [as_float, float_gradient] = run(at::kFloat);
  const auto [as_double, double_gradient] = run(at::kDouble);
  const at::Tensor plain = plain_convolution(picture, weights, bias, c);
  EXPECT_LT(relative_difference(as_double, plain), 1e-12);
  EXPECT_LT(relative_difference(as_float, plain), 5e-6);
  EXPECT_LT(relative_difference(float_gradient, double_gradient), 5e-6);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero, Padding::valid}) {
    all.push_back({3, 16, 3, 1, 13, 17, padding, true, true, true});
    all.push_back({16, 32, 3, 1, 14, 9, padding, false, true, true});
    all.push_back({20, 24, 3, 1, 8, 11, padding, false, false, false});
    all.push_back({5, 12, 7, 2, 15, 16, padding, true, false, true});
    all.push_back({18, 7, 5, 1, 12, 12, padding, false, true, false});
  }
  all.push_back({4, 8, 1, 1, 5, 6, Padding::circular, false, true, true});
  all.push_back(
      {3, 8, 7, 4, 8, 8, Padding::circular, true, false, true});  // wider than the picture
  return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, ConvolutionTest, testing::ValuesIn(cases()));

TEST(Convolution, RadiusKeepsTheSize) {
  EXPECT_EQ(Convolution(at::zeros({1, 1, 7, 7}), {}, 4).radius(), 12);
}

}  // namespace
}  // namespace gramloom::neural
