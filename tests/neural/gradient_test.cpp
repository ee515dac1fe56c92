// The gradient of the whole loss on a tiny picture against finite differences in double.
#include <gtest/gtest.h>

#include "networks.h"
#include "neural/loss/loss.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

struct GradientCase {
  Padding padding;
  Pooling pooling;
  GramParams options;
};

NetworkDescription tiny_network() {
  NetworkDescription network;
  network.name = "tiny";
  network.layers = {{"conv1", ConvolutionLayer{6, 3, 1}},
                    {"relu1", ReluLayer{}},
                    {"pool1", AveragePoolLayer{}},
                    {"bank2", BankLayer{4, {3, 3}, {1, 2}, {0, 0.6}}},
                    {"relu2", ReluLayer{}}};
  return network;
}

// The Gram matrices alone, compared like that.
NeuralParams grams(const GramParams& options) {
  NeuralParams params = with_preset(Preset::gatys);
  static_cast<GramParams&>(params) = options;
  return params;
}

class GradientTest : public testing::TestWithParam<GradientCase> {};

TEST_P(GradientTest, MatchesFiniteDifferences) {
  const GradientCase c = GetParam();
  const NetworkDescription description = tiny_network();
  const Network network = random_network(description, at::kDouble, c.pooling);
  const Edges edges{c.padding, c.padding};
  const at::Tensor exemplar = numbers({2, 16, 18}, 1, at::kDouble);
  const at::Tensor picture = numbers({2, 15, 17}, 2, at::kDouble);
  const MatchedNetwork matched{network, description, {{0, 0.5}, {1, 1}, {2, 2}, {4, 1.5}}};
  Loss loss(grams(c.options), &matched, exemplar, edges, {size_of(picture), Tile::both}, edges,
            Random(1));

  at::Tensor gradient = at::empty_like(picture), unused = at::empty_like(picture);
  loss(picture, 0, gradient);
  ASSERT_GT(gradient.abs().max().item<double>(), 0);
  Random random(9);
  for (int trial = 0; trial < 6; ++trial) {  // along random directions, all pixels at once
    const at::Tensor direction = numbers(picture.sizes(), 100 + random.bits(), at::kDouble);
    const double step = 1e-6;
    const double difference = (loss(picture + step * direction, 0, unused) -
                               loss(picture - step * direction, 0, unused)) /
                              (2 * step);
    const double slope = (gradient * direction).sum().item<double>();
    EXPECT_NEAR(slope, difference, 1e-5 * gradient.norm().item<double>());
  }
}

std::vector<GradientCase> gradient_cases() {
  std::vector<GradientCase> all;
  for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero, Padding::valid})
    for (const auto pooling : {Pooling::average, Pooling::max})
      all.push_back({padding, pooling, {1, true, true, true, {}}});
  for (int options = 0; options < 8; ++options)
    all.push_back({Padding::circular,
                   Pooling::average,
                   {1, (options & 1) != 0, (options & 2) != 0, (options & 4) != 0, {}}});
  all.push_back({Padding::circular, Pooling::average, {1, true, true, true, {1, 2}}});
  all.push_back({Padding::reflect, Pooling::average, {1, false, false, false, {1}}});
  return all;
}

TEST(PyramidGradient, MatchesFiniteDifferences) {
  const NetworkDescription description = pyramid_network();
  const Network network = random_network(description, at::kDouble);
  for (const auto padding : {Padding::circular, Padding::reflect, Padding::zero}) {
    const Edges edges{padding, padding};
    const at::Tensor picture = numbers({2, 13, 18}, 2, at::kDouble);  // odd: sizes 13, 7, 4
    const MatchedNetwork matched{network, description, {{1, 1}, {3, 0.5}}};
    Loss loss(grams({1, true, true, true, {}}), &matched, numbers({2, 16, 18}, 1, at::kDouble),
              edges, {size_of(picture), Tile::both}, edges, Random(1));
    at::Tensor gradient = at::empty_like(picture), unused = at::empty_like(picture);
    loss(picture, 0, gradient);
    for (std::uint64_t trial = 0; trial < 4; ++trial) {
      const at::Tensor direction = numbers(picture.sizes(), 50 + trial, at::kDouble);
      const double step = 1e-6;
      const double difference = (loss(picture + step * direction, 0, unused) -
                                 loss(picture - step * direction, 0, unused)) /
                                (2 * step);
      EXPECT_NEAR((gradient * direction).sum().item<double>(), difference,
                  1e-5 * gradient.norm().item<double>());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, GradientTest, testing::ValuesIn(gradient_cases()));

}  // namespace
}  // namespace gramloom::neural
