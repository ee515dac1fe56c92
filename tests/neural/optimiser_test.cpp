#include "neural/optimise/optimiser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "neural/optimise/line_search.h"
#include "tensors.h"

namespace gramloom::neural {
namespace {

// ½ xᵀ A x − bᵀ x with eigenvalues from 1 to 100.
struct Quadratic {
  at::Tensor a = at::diag(at::logspace(0, 2, 12, 10, at::kDouble));
  at::Tensor b = numbers({12}, 1, at::kDouble);
  int evaluations = 0;

  double operator()(const at::Tensor& x, at::Tensor& gradient) {
    ++evaluations;
    gradient.copy_(at::mv(a, x) - b);
    return (0.5 * at::dot(x, at::mv(a, x)) - at::dot(b, x)).item<double>();
  }
};

double rosenbrock(const at::Tensor& x, at::Tensor& gradient) {
  const double a = x[0].item<double>(), b = x[1].item<double>();
  gradient[0] = -2 * (1 - a) - 400 * a * (b - a * a);
  gradient[1] = 200 * (b - a * a);
  return (1 - a) * (1 - a) + 100 * (b - a * a) * (b - a * a);
}

TEST(Lbfgs, SolvesAQuadraticInAFewSteps) {
  auto objective = std::make_shared<Quadratic>();
  const Objective call = [&](const at::Tensor& x, at::Tensor& g) { return (*objective)(x, g); };
  at::Tensor x = at::zeros({12}, at::kDouble);
  Lbfgs lbfgs(20);
  for (int i = 0; i < 40; ++i) lbfgs.step(x, call);
  EXPECT_LT(relative_difference(at::mv(objective->a, x), objective->b), 1e-6);
}

TEST(Lbfgs, SolvesRosenbrocksValley) {
  at::Tensor x = at::tensor({-1.2, 1.0}, at::kDouble);
  Lbfgs lbfgs(10);
  double loss = 1;
  for (int i = 0; i < 60 && !lbfgs.converged(); ++i) loss = lbfgs.step(x, rosenbrock);
  EXPECT_LT(loss, 1e-12);
  EXPECT_NEAR(x[0].item<double>(), 1, 1e-5);
}

TEST(Lbfgs, TheLossNeverRises) {
  at::Tensor x = at::tensor({-1.2, 1.0}, at::kDouble);
  Lbfgs lbfgs(3);
  double loss = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 60; ++i) {
    const double next = lbfgs.step(x, rosenbrock);
    EXPECT_LE(next, loss);
    loss = next;
  }
}

TEST(Lbfgs, StopsWhereTheGradientIsZero) {
  at::Tensor x = at::tensor({1.0, 1.0}, at::kDouble);
  Lbfgs lbfgs(3);
  lbfgs.step(x, rosenbrock);
  EXPECT_TRUE(lbfgs.converged());
  EXPECT_TRUE(at::equal(x, at::tensor({1.0, 1.0}, at::kDouble)));
}

template <class Method>
void goes_on_as_if_it_had_not_stopped(Method whole, Method first, Method second) {
  at::Tensor x = at::tensor({-1.2, 1.0}, at::kDouble), y = x.clone();
  for (int i = 0; i < 20; ++i) whole.step(x, rosenbrock);
  for (int i = 0; i < 7; ++i) first.step(y, rosenbrock);
  second.load(first.save());
  for (int i = 7; i < 20; ++i) second.step(y, rosenbrock);
  EXPECT_TRUE(at::equal(x, y));
}

TEST(Lbfgs, GoesOnFromASavedState) {
  goes_on_as_if_it_had_not_stopped(Lbfgs(4), Lbfgs(4), Lbfgs(4));
}
TEST(Adam, GoesOnFromASavedState) {
  goes_on_as_if_it_had_not_stopped(Adam(0.01, 100), Adam(0.01, 100), Adam(0.01, 100));
}

TEST(Adam, TheFirstStepIsTheLearningRateAlongTheGradientsSign) {
  at::Tensor x = at::tensor({-1.2, 1.0}, at::kDouble);
  at::Tensor gradient = at::empty_like(x);
  rosenbrock(x, gradient);
  const at::Tensor expected = x - 0.05 * at::sign(gradient);
  Adam(0.05, 10).step(x, rosenbrock);
  EXPECT_LT(relative_difference(x, expected), 1e-8);
}

class LineSearch : public testing::TestWithParam<double> {};

TEST_P(LineSearch, MeetsTheStrongWolfeConditions) {
  // Moré, Thuente 1994, function 5.1: −t/(t² + 2).
  const auto phi = [](double t) {
    return LinePoint{t, -t / (t * t + 2), (t * t - 2) / ((t * t + 2) * (t * t + 2))};
  };
  const LinePoint start = phi(0), found = search_line(phi, start, GetParam());
  EXPECT_LE(found.value, start.value + 1e-4 * found.t * start.slope);
  EXPECT_LE(std::abs(found.slope), -0.9 * start.slope);
  EXPECT_DOUBLE_EQ(found.value, phi(found.t).value);
}

INSTANTIATE_TEST_SUITE_P(FirstSteps, LineSearch, testing::Values(1e-3, 0.1, 1.0, 10.0, 1e3));

TEST(LineSearch, SurvivesAStepThatOverflows) {
  const auto wall = [](double t) {
    if (t > 1) return LinePoint{t, std::numeric_limits<double>::quiet_NaN(), 0};
    return LinePoint{t, -t + t * t, -1 + 2 * t};
  };
  const LinePoint found = search_line(wall, wall(0), 1000);
  EXPECT_GT(found.t, 0);
  EXPECT_LE(found.value, 0);
}

TEST(Adam, MovesALargePictureAsItDoesASmallOne) {
  const std::int64_t count = 3 * 900 * 900;
  const at::Tensor scale = at::linspace(0.1, 2, count);
  at::Tensor x = at::linspace(-1, 1, count), last = x.narrow(0, count - 1000, 1000).clone();
  const auto bowl = [](const at::Tensor& factors) {
    return Objective([&factors](const at::Tensor& at, at::Tensor& gradient) {
      at::mul_out(gradient, at, factors);
      return 1.0;
    });
  };
  Adam large(0.05, 10), small(0.05, 10);
  const at::Tensor scale_of_last = scale.narrow(0, count - 1000, 1000).clone();
  for (int i = 0; i < 5; ++i) {
    large.step(x, bowl(scale));
    small.step(last, bowl(scale_of_last));
  }
  EXPECT_LT((x.narrow(0, count - 1000, 1000) - last).abs().max().item<double>(), 1e-5);
}

}  // namespace
}  // namespace gramloom::neural
