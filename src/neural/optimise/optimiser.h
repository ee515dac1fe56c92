#pragma once

#include <ATen/ATen.h>

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <variant>

#include "neural/group.h"

namespace gramloom::neural {

/// The loss at x, its gradient written to `gradient` (same shape as x).
using Objective = std::function<double(const at::Tensor& x, at::Tensor& gradient)>;

/// Everything an optimiser needs to go on later exactly as if it had not stopped.
struct SavedState {
  std::map<std::string, at::Tensor> tensors;
  std::map<std::string, double> numbers;
};

/// Limited-memory BFGS (Liu, Nocedal 1989) with a line search for the strong Wolfe conditions
/// (Nocedal, Wright 2006, algorithms 3.5 and 3.6 with cubic interpolation, c₁ = 1e-4, c₂ = 0.9).
/// x is changed in place; it is the optimiser's vector and the picture at once.
/// Not torch::optim::LBFGS: in a single call it gets as far with as many evaluations, but step by
/// step, as reports and checkpoints need it, it evaluates each start again (after 100 evaluations
/// 1.01 to 1.7 times this one's loss on six problems), and saving its state failed with 1.13.
class Lbfgs {
 public:
  /// x is this process' part of a vector that a group has.
  explicit Lbfgs(int history, const Group& group = one_process())
      : history_(history), group_(group) {}

  /// One step, of one evaluation or a few more. Returns the loss after it. When no lower loss can
  /// be found along the gradient itself, x stays as it is and `converged` becomes true.
  double step(at::Tensor& x, const Objective& objective);
  bool converged() const { return converged_; }

  SavedState save() const;
  void load(const SavedState& state);

 private:
  double scalar_product(const at::Tensor& a, const at::Tensor& b) const;
  at::Tensor direction() const;
  void remember(const at::Tensor& moved, const at::Tensor& gradient_change);

  int history_;
  const Group& group_;
  bool converged_ = false;
  double value_ = 0;
  at::Tensor gradient_;
  struct Pair {
    at::Tensor s, y;  // change of x and of the gradient
    double inverse_sy;
  };
  std::deque<Pair> pairs_;
};

/// Adam (Kingma, Ba 2015, algorithm 1; β₁ = 0.8, β₂ = 0.99, ε = 1e-12, since gradients fall with
/// the number of pixels; all below the paper's because the gradient's size falls by orders of
/// magnitude within a synthesis).
class Adam {
 public:
  /// The step falls linearly from learning_rate to a tenth of it at `steps`: large steps leave
  /// noise, which smaller ones then take out.
  Adam(double learning_rate, std::int64_t steps) : learning_rate_(learning_rate), planned_(steps) {}

  /// One step, one evaluation. Returns the loss before it.
  double step(at::Tensor& x, const Objective& objective);
  bool converged() const { return false; }

  SavedState save() const;
  void load(const SavedState& state);

 private:
  double learning_rate_;
  std::int64_t planned_, steps_ = 0;
  at::Tensor first_, second_, gradient_;
};

using AnyOptimiser = std::variant<Lbfgs, Adam>;

}  // namespace gramloom::neural
