// The sliced Wasserstein distance of feature maps; Gram matrices are in moments_test.cpp and
// gradient_test.cpp, both a few rows at a time in rows_test.cpp.
#include "neural/loss/features.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "feature_terms.h"
#include "neural/network/make_network.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

NetworkDescription two_scales() {
  NetworkDescription network;
  network.name = "two_scales";
  network.layers = {{"pyramid1", PyramidLayer{4, 3, 2}}, {"relu1", ReluLayer{}}};
  return network;
}

constexpr Edges circular{Padding::circular, Padding::circular};

// One description, its filters and the terms of one exemplar.
struct Seen {
  Seen(const at::Tensor& exemplar, NeuralParams params, Edges exemplar_edges = circular)
      : description(two_scales()),
        network(make(description)),
        terms({network, description, {{1, 0.5}}}, feature_terms(params, exemplar), exemplar,
              exemplar_edges, circular) {}

  static Network make(const NetworkDescription& description) {
    const auto shapes = filter_shapes(description, 3);
    return {description, shapes, random_filters(shapes, RandomWeights::he_normal, 3),
            Pooling::as_described};
  }
  static NeuralParams settings(int directions) {
    NeuralParams params = with_preset(Preset::gatys);
    params.gram_weight = 0;
    params.sliced_features_weight = 2;
    params.directions = directions;
    return params;
  }

  double value(const at::Tensor& picture, std::uint64_t step = 0) {
    at::Tensor gradient = at::zeros_like(picture);
    return terms.add(picture, step, gradient).at(0).value;
  }

  NetworkDescription description;
  Network network;
  Features terms;
};

TEST(SlicedFeatures, ZeroForTheExemplarItselfAndItsShifts) {
  const at::Tensor exemplar = numbers({3, 16, 24}, 1);
  Seen f(exemplar, Seen::settings(8));
  for (const std::uint64_t step : {0, 5}) {
    EXPECT_LT(f.value(exemplar, step), 1e-6);
    EXPECT_LT(f.value(at::roll(exemplar, {2, 6}, {1, 2}).contiguous(), step), 1e-5);
  }
  EXPECT_GT(f.value(numbers({3, 16, 24}, 2)), 1e-2);
}

// Along each direction, by sorting with the standard library.
TEST(SlicedFeatures, AreTheDistanceOfSortedProjections) {
  const at::Tensor exemplar = numbers({3, 12, 10}, 1), picture = numbers({3, 12, 10}, 2);
  const std::uint64_t step = 3;
  Seen f(exemplar, Seen::settings(5));
  const auto sorted = [&](const FeatureMaps& maps, std::uint64_t map, int direction,
                          std::uint64_t at_step) {
    Random random = Random(1).stream(0).stream(at_step).stream(map);
    std::vector<double> d(4);
    for (int skipped = 0; skipped <= direction; ++skipped)
      for (double& v : d) v = static_cast<double>(random.normal());
    double norm = 0;
    for (const double v : d) norm += v * v;
    const at::Tensor rows = to_rows(maps).contiguous();
    std::vector<double> values;
    for (std::int64_t p = 0; p < rows.size(0); ++p) {
      double sum = 0;
      for (std::int64_t c = 0; c < 4; ++c)
        sum += rows[p][c].item<double>() * d[static_cast<std::size_t>(c)] / std::sqrt(norm);
      values.push_back(sum);
    }
    std::sort(values.begin(), values.end());
    return values;
  };
  const auto own = f.network(picture, circular, {1})[0],
             goal = f.network(exemplar, circular, {1})[0];
  double expected = 0;
  for (std::size_t map = 0; map < 2; ++map) {
    double distance = 0, flat = 0;
    for (int direction = 0; direction < 5; ++direction) {
      const auto a = sorted(own[map], map, direction, step);
      const auto b = sorted(goal[map], map, direction, step);
      for (std::size_t i = 0; i < a.size(); ++i)
        distance += std::abs(a[i] - b[i]) / static_cast<double>(a.size());
      const auto first = sorted(goal[map], map, direction, 0);
      double mean = 0;
      for (const double v : first) mean += v / static_cast<double>(first.size());
      for (const double v : first) flat += std::abs(v - mean) / static_cast<double>(first.size());
    }
    expected += distance / flat / 2;
  }
  EXPECT_NEAR(f.value(picture, step), 2 * 0.5 * expected, 1e-5 * expected);
}

TEST(SlicedFeatures, GradientMatchesFiniteDifferences) {
  const at::Tensor exemplar = numbers({3, 16, 18}, 1);
  // Stronger than the exemplar: few values are near the ones that they go to, where W₁ bends.
  const at::Tensor picture = 4 * numbers({3, 14, 20}, 2);
  Seen f(exemplar, Seen::settings(16), {Padding::reflect, Padding::reflect});
  at::Tensor gradient = at::zeros_like(picture);
  f.terms.add(picture, 1, gradient);
  for (std::uint64_t trial = 0; trial < 4; ++trial) {
    const at::Tensor direction = numbers(picture.sizes(), 50 + trial);
    const double h = 5e-4;
    const double difference =
        (f.value(picture + h * direction, 1) - f.value(picture - h * direction, 1)) / (2 * h);
    EXPECT_NEAR((gradient * direction).sum().item<double>(), difference,
                0.03 * gradient.norm().item<double>());
  }
}

TEST(SlicedFeatures, StepsHaveDirectionsOfTheirOwn) {
  const at::Tensor exemplar = numbers({3, 12, 12}, 1), picture = numbers({3, 12, 12}, 2);
  Seen f(exemplar, Seen::settings(4));
  const double first = f.value(picture, 0);
  EXPECT_NE(first, f.value(picture, 1));
  EXPECT_EQ(first, f.value(picture, 0));
}

TEST(SlicedFeatures, AFlatExemplarAsksForNothing) {
  Seen f(at::full({3, 12, 12}, 0.4f), Seen::settings(4));
  EXPECT_EQ(f.value(numbers({3, 12, 12}, 2)), 0);
}

// A large exemplar's filters are rescaled on its middle, whose activations are 1 or nearly.
TEST(MakeNetwork, RescalesOnTheMiddleOfALargeExemplar) {
  NeuralParams params = with_preset(Preset::gatys);
  NetworkDescription description = two_scales();
  at::Tensor exemplar = numbers({3, 700, 700}, 1) * 10;
  exemplar.narrow(1, 94, 512).narrow(2, 94, 512).div_(10);
  const Network network = make_network(params, description, exemplar);
  const at::Tensor inside = exemplar.narrow(1, 94, 512).narrow(2, 94, 512).contiguous();
  const auto maps = network(inside, {Padding::reflect, Padding::reflect}, {1})[0];
  for (const auto& scale : maps)
    EXPECT_LT(relative_difference(to_rows(scale).mean(0), at::ones({4})), 1e-4);
}

}  // namespace
}  // namespace gramloom::neural
