#include "neural/optimise/optimiser.h"

#include <fmt/format.h>

#include <cmath>

#include "core/threads.h"
#include "neural/openmp.h"
#include "neural/optimise/line_search.h"
#include "neural/shared_rows.h"

namespace gramloom::neural {

namespace {

// Values of a picture that Adam moves in parts, all of whose numbers stay in the cache.
constexpr std::int64_t large = 1 << 21;
constexpr std::int64_t values_at_once = 1 << 14;

}  // namespace

double Lbfgs::scalar_product(const at::Tensor& a, const at::Tensor& b) const {
  return sum_of(group_, at::dot(a.view(-1), b.view(-1)).item<double>());
}

at::Tensor Lbfgs::direction() const {
  // The two-loop recursion (Nocedal, Wright 2006, algorithm 7.4), started at −gradient.
  at::Tensor d = gradient_.neg();
  std::vector<double> alphas(pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    alphas[i] = scalar_product(pairs_[i].s, d) * pairs_[i].inverse_sy;
    d.add_(pairs_[i].y, -alphas[i]);
  }
  if (!pairs_.empty()) {
    const auto& last = pairs_.back();
    d.mul_(1 / (last.inverse_sy * scalar_product(last.y, last.y)));
  }
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const double beta = scalar_product(pairs_[i].y, d) * pairs_[i].inverse_sy;
    d.add_(pairs_[i].s, alphas[i] - beta);
  }
  return d;
}

void Lbfgs::remember(const at::Tensor& moved, const at::Tensor& gradient_change) {
  const double sy = scalar_product(moved, gradient_change);
  if (!(sy > 1e-10 * scalar_product(gradient_change, gradient_change))) return;  // keeps H positive
  if (pairs_.size() == static_cast<std::size_t>(history_)) pairs_.pop_front();
  pairs_.push_back({moved, gradient_change, 1 / sy});
}

double Lbfgs::step(at::Tensor& x, const Objective& objective) {
  if (!gradient_.defined()) {
    gradient_ = at::empty_like(x);
    value_ = objective(x, gradient_);
  }
  at::Tensor d = direction();
  double slope = scalar_product(d, gradient_);
  if (!(slope < 0)) {  // the memory has become useless: begin anew
    pairs_.clear();
    d = gradient_.neg();
    slope = scalar_product(d, gradient_);
  }
  if (!(slope < 0) || !std::isfinite(value_)) {
    converged_ = true;
    return value_;
  }
  const double first = pairs_.empty()
                           ? std::min(1.0, 1 / sum_of(group_, gradient_.abs().sum().item<double>()))
                           : 1.0;
  const at::Tensor origin = x.clone();
  at::Tensor gradient = at::empty_like(x);
  double last = 0;
  const auto evaluate = [&](double t) {
    at::add_out(x, origin, d, t);
    const double value = objective(x, gradient);
    last = t;
    return LinePoint{t, value, scalar_product(d, gradient)};
  };
  const LinePoint found = search_line(evaluate, {0, value_, slope}, first);
  if (found.t == 0) {  // nothing lower in this direction
    x.copy_(origin);
    converged_ = pairs_.empty();
    pairs_.clear();
    return value_;
  }
  if (found.t != last) evaluate(found.t);  // x and gradient of the point taken, not the last tried
  remember(d.mul_(found.t), gradient - gradient_);
  gradient_ = gradient;
  return value_ = found.value;
}

SavedState Lbfgs::save() const {
  SavedState state;
  state.numbers = {{"value", value_},
                   {"converged", converged_ ? 1.0 : 0.0},
                   {"pairs", static_cast<double>(pairs_.size())}};
  if (gradient_.defined()) state.tensors["gradient"] = gradient_;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    state.tensors[fmt::format("s{}", i)] = pairs_[i].s;
    state.tensors[fmt::format("y{}", i)] = pairs_[i].y;
    state.numbers[fmt::format("inverse_sy{}", i)] = pairs_[i].inverse_sy;
  }
  return state;
}

void Lbfgs::load(const SavedState& state) {
  value_ = state.numbers.at("value");
  converged_ = state.numbers.at("converged") != 0;
  if (const auto found = state.tensors.find("gradient"); found != state.tensors.end())
    gradient_ = found->second;
  pairs_.clear();
  for (int i = 0; i < static_cast<int>(state.numbers.at("pairs")); ++i)
    pairs_.push_back({state.tensors.at(fmt::format("s{}", i)),
                      state.tensors.at(fmt::format("y{}", i)),
                      state.numbers.at(fmt::format("inverse_sy{}", i))});
}

double Adam::step(at::Tensor& x, const Objective& objective) {
  constexpr double decay1 = 0.8, decay2 = 0.99, epsilon = 1e-12;
  if (!first_.defined()) {
    first_ = at::zeros_like(x);
    second_ = at::zeros_like(x);
  }
  if (!gradient_.defined()) gradient_ = at::empty_like(x);
  const double value = objective(x, gradient_);
  ++steps_;
  const double correction1 = 1 - std::pow(decay1, steps_);
  const double correction2 = std::sqrt(1 - std::pow(decay2, steps_));
  const double done = static_cast<double>(steps_ - 1) / static_cast<double>(planned_);
  const double rate = learning_rate_ * (1 - 0.9 * std::min(1.0, done)) / correction1;
  const auto move = [&](at::Tensor part, const at::Tensor& gradient, at::Tensor first,
                        at::Tensor second) {
    first.mul_(decay1).add_(gradient, 1 - decay1);
    second.mul_(decay2).addcmul_(gradient, gradient, 1 - decay2);
    const at::Tensor scale = second.sqrt().div_(correction2).add_(epsilon);
    part.addcdiv_(first, scale, -rate);
  };
  if (x.numel() <= large || !x.is_contiguous()) {
    move(x, gradient_, first_, second_);
    return value;
  }
  parallel_for(x.numel(), values_at_once, [&](std::int64_t begin, std::int64_t end) {
    const InThisThread in_this_thread;
    const auto part = [&](const at::Tensor& t) { return t.view(-1).narrow(0, begin, end - begin); };
    move(part(x), part(gradient_), part(first_), part(second_));
  });
  return value;
}

SavedState Adam::save() const {
  SavedState state;
  state.numbers["steps"] = static_cast<double>(steps_);
  if (first_.defined()) state.tensors = {{"first", first_}, {"second", second_}};
  return state;
}

void Adam::load(const SavedState& state) {
  steps_ = static_cast<std::int64_t>(state.numbers.at("steps"));
  if (state.tensors.contains("first")) {
    first_ = state.tensors.at("first");
    second_ = state.tensors.at("second");
  }
}

}  // namespace gramloom::neural
