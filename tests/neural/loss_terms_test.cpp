// What holds for every term of the loss, over the list of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/threads.h"
#include "networks.h"
#include "neural/loss/loss.h"
#include "neural/settings.h"
#include "neural/synthesis.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

template <class>
struct TypesOf;
template <class... Terms>
struct TypesOf<std::variant<Terms...>> {
  using Types = testing::Types<Terms...>;
};

constexpr Edges both_circular{Padding::circular, Padding::circular};

// The weight of a term is the first of its fields.
template <class Params>
NeuralParams only(double weight) {
  NeuralParams params;
  for_each_alternative<LossTerms>([&]<class Other>(std::type_identity<Other>) {
    static_cast<Other&>(params).*std::get<0>(Other::fields()).member =
        std::is_same_v<Other, Params> ? weight : 0;
  });
  params.patch_sizes = {3};
  params.directions = 24;
  return params;
}

// A loss of that term alone; pictures have two channels.
struct Alone {
  Alone(const NeuralParams& params, const at::Tensor& exemplar, Size target)
      : description(pyramid_network()),
        network(random_network(description, at::kFloat)),
        matched{network, description, {{1, 1}, {3, 0.5}}},
        loss(params, &matched, exemplar, both_circular, {target, Tile::both}, both_circular,
             Random(1)) {}

  double value(const at::Tensor& picture, std::uint64_t step = 0) {
    at::Tensor unused = at::empty_like(picture);
    return loss(picture, step, unused);
  }

  NetworkDescription description;
  Network network;
  MatchedNetwork matched;
  Loss loss;
};

// A picture that tiles and has all of its patches, lags and differences again and again, so that
// what the terms see beyond an edge is what they see inside.
at::Tensor periodic() { return numbers({2, 4, 8}, 1).repeat({1, 10, 5}).contiguous(); }

template <class Params>
class EveryTerm : public testing::Test {};
TYPED_TEST_SUITE(EveryTerm, TypesOf<LossTerms>::Types);

TYPED_TEST(EveryTerm, HasItsNameInTheTraceAndInItsKey) {
  const at::Tensor exemplar = numbers({2, 24, 20}, 1);
  Alone alone(only<TypeParam>(2), exemplar, {22, 26});
  const double value = alone.value(numbers({2, 26, 22}, 2));
  double sum = 0;
  for (const auto& term : alone.loss.terms()) {
    EXPECT_TRUE(
        term.name == TypeParam::name ||
        (LooksAtNetwork<TypeParam> && (term.name == std::string(TypeParam::name) + "_relu1" ||
                                       term.name == std::string(TypeParam::name) + "_relu2")))
        << term.name;
    sum += term.value;
  }
  EXPECT_EQ(alone.loss.terms().size(), LooksAtNetwork<TypeParam> ? 2u : 1u);
  EXPECT_EQ(sum, value);
  EXPECT_EQ(std::get<0>(TypeParam::fields()).name, std::string(TypeParam::name) + "_weight");
  EXPECT_EQ(static_cast<const TypeParam&>(only<TypeParam>(3)).weight(), 3);
}

TYPED_TEST(EveryTerm, NothingAtTheExemplar) {
  const at::Tensor exemplar = periodic();
  Alone alone(only<TypeParam>(1), exemplar, size_of(exemplar));
  const double other = alone.value(3 * numbers(exemplar.sizes(), 2));
  EXPECT_GT(other, 0.5);
  EXPECT_LT(alone.value(exemplar), 0.05 * other);
}

TYPED_TEST(EveryTerm, GradientMatchesFiniteDifferences) {
  const at::Tensor exemplar = numbers({2, 24, 20}, 1);
  // Stronger than the exemplar: few values are near the ones that they go to, where W₁ bends.
  const at::Tensor picture = 3 * numbers({2, 26, 22}, 2);
  for (const double weight : {1.0, 0.25}) {
    Alone alone(only<TypeParam>(weight), exemplar, {22, 26});
    at::Tensor gradient = at::empty_like(picture);
    alone.loss(picture, 1, gradient);
    const double norm = gradient.norm().template item<double>();
    ASSERT_GT(norm, 0);
    const at::Tensor along = gradient / norm;
    for (std::uint64_t trial = 0; trial < 4; ++trial) {
      const at::Tensor direction = along + numbers(picture.sizes(), 10 + trial) / 40;
      const double h = 2e-3;
      const double difference =
          (alone.value(picture + h * direction, 1) - alone.value(picture - h * direction, 1)) /
          (2 * h);
      EXPECT_NEAR((gradient * direction).sum().template item<double>(), difference, 0.03 * norm);
    }
  }
}

TYPED_TEST(EveryTerm, ItsWeightIsAFactor) {
  const at::Tensor exemplar = numbers({2, 24, 20}, 1), picture = numbers({2, 26, 22}, 2);
  const auto of = [&](double weight) {
    at::Tensor gradient = at::empty_like(picture);
    Alone alone(only<TypeParam>(weight), exemplar, {22, 26});
    const double value = alone.loss(picture, 0, gradient);
    return std::pair{value, gradient};
  };
  const auto one = of(1), three = of(3);
  EXPECT_NEAR(three.first, 3 * one.first, 1e-6 * three.first);
  EXPECT_LT(relative_difference(three.second, 3 * one.second), 1e-5);
}

TYPED_TEST(EveryTerm, DoesNotDependOnTheNumberOfThreads) {
  const at::Tensor exemplar = numbers({2, 70, 60}, 1), picture = numbers({2, 90, 80}, 2);
  const auto with = [&](int threads) {
    set_thread_count(threads);
    at::Tensor gradient = at::empty_like(picture);
    Alone alone(only<TypeParam>(1), exemplar, {80, 90});
    const double value = alone.loss(picture, 0, gradient);
    set_thread_count(0);
    return std::pair{value, gradient};
  };
  const auto one = with(1), two = with(2), five = with(5);
  EXPECT_NEAR(one.first, two.first, 1e-6 * one.first);
  EXPECT_NEAR(one.first, five.first, 1e-6 * one.first);
  EXPECT_LT(relative_difference(one.second, two.second), 1e-5);
  EXPECT_LT(relative_difference(one.second, five.second), 1e-5);
}

TYPED_TEST(EveryTerm, CostsMoreForLargerPictures) {
  NetworkDescription description = pyramid_network();
  const auto shapes = filter_shapes(description, 3);
  const auto of = [&](int side) {
    const auto work = network_work(description, shapes, {{1, 1}}, {side, side}, 3);
    const double pixels = static_cast<double>(side) * side;
    NeuralParams params = only<TypeParam>(1);
    params.shifts = {1};
    return cost(static_cast<const TypeParam&>(params), {pixels, pixels, 3, 24, work, work});
  };
  EXPECT_GT(seconds(of(64).work), 0);
  EXPECT_GT(of(64).bytes, 0);
  EXPECT_GT(seconds(of(256).work), 8 * seconds(of(64).work));
  EXPECT_GT(of(256).bytes, 4 * of(64).bytes);
}

TYPED_TEST(EveryTerm, IsInTheEstimate) {
  NeuralParams params = only<TypeParam>(1);
  const auto expected = [&] {
    const RequestSize request{
        .exemplars = {{{128, 128}, 3}}, .size = {256, 256}, .tile = Tile::both};
    return seconds(estimate(params, request).work);
  };
  params.iterations = {100};
  const double some = expected();
  params.iterations = {200};
  EXPECT_GT(expected(), 1.5 * some);
  EXPECT_EQ(needs_network(params), LooksAtNetwork<TypeParam>);
}

TEST(LossTerms, AllOffIsAnErrorThatNamesThem) {
  EXPECT_THROW(check_settings(only<void>(1)), ConfigError);
}

}  // namespace
}  // namespace gramloom::neural
