#include "train/optimiser_state.h"

#include "core/error.h"

namespace gramloom::train {

namespace {

// LibTorch 1 (Debian 12) and 2 (Debian 13) know a parameter's state by different keys.
auto state_key(const at::Tensor& parameter) {
#if TORCH_VERSION_MAJOR >= 2
  return static_cast<void*>(parameter.unsafeGetTensorImpl());
#else
  return c10::guts::to_string(parameter.unsafeGetTensorImpl());
#endif
}

template <class F>
void for_each_tensor(const torch::nn::Module& module, const std::string& prefix, F&& f) {
  for (const auto& item : module.named_parameters()) f(prefix + item.key(), item.value());
  for (const auto& item : module.named_buffers()) f(prefix + item.key(), item.value());
}

// Calls f(name, parameter) for all parameters in their order.
template <class F>
void for_each_parameter(torch::optim::Adam& optimiser, const std::string& prefix, F&& f) {
  int number = 0;
  for (const auto& group : optimiser.param_groups())
    for (const at::Tensor& parameter : group.params())
      f(fmt::format("{}{}.", prefix, number++), parameter);
}

}  // namespace

at::Tensor to_tensor(const Tensors& tensors, const std::string& name, at::IntArrayRef shape) {
  const auto found = tensors.find(name);
  if (found == tensors.end()) throw Error("the state of a training lacks '{}'", name);
  const TensorData& data = found->second;
  if (at::IntArrayRef(data.shape) != shape)
    throw Error("the state of a training has another shape of '{}'", name);
  return neural::to_tensor(data);
}

void keep(const torch::nn::Module& module, const std::string& prefix, Tensors& tensors) {
  for_each_tensor(module, prefix, [&](const std::string& name, const at::Tensor& value) {
    tensors[name] = to_data(value);
  });
}

void restore(torch::nn::Module& module, const std::string& prefix, const Tensors& tensors) {
  const torch::NoGradGuard no_gradients;
  for_each_tensor(module, prefix, [&](const std::string& name, at::Tensor value) {
    value.copy_(to_tensor(tensors, name, value.sizes()));
  });
}

void keep(torch::optim::Adam& optimiser, const std::string& prefix, Tensors& tensors) {
  for_each_parameter(optimiser, prefix, [&](const std::string& name, const at::Tensor& parameter) {
    const auto found = optimiser.state().find(state_key(parameter));
    if (found == optimiser.state().end()) return;
    const auto& state = static_cast<const torch::optim::AdamParamState&>(*found->second);
    tensors[name + "mean"] = to_data(state.exp_avg());
    tensors[name + "square"] = to_data(state.exp_avg_sq());
    tensors[name + "steps"] = {{}, {static_cast<float>(state.step())}};
  });
}

void restore(torch::optim::Adam& optimiser, const std::string& prefix, const Tensors& tensors) {
  for_each_parameter(optimiser, prefix, [&](const std::string& name, const at::Tensor& parameter) {
    if (!tensors.contains(name + "mean")) return;
    auto state = std::make_unique<torch::optim::AdamParamState>();
    const auto like_parameter = [&](const std::string& what) {
      return at::empty_like(parameter).copy_(to_tensor(tensors, name + what, parameter.sizes()));
    };
    const torch::NoGradGuard no_gradients;
    state->exp_avg(like_parameter("mean"));
    state->exp_avg_sq(like_parameter("square"));
    state->step(static_cast<std::int64_t>(tensors.at(name + "steps").values.at(0)));
    optimiser.state()[state_key(parameter)] = std::move(state);
  });
}

}  // namespace gramloom::train
