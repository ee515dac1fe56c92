// Seconds of one evaluation of the loss with its gradient, by network and size; the Gram matrix
// alone; L-BFGS alone. Run: build/tests/bench/neural_bench [--benchmark_filter=…]
#include <ATen/Parallel.h>
#include <benchmark/benchmark.h>
#include <c10/core/GradMode.h>

#include "core/threads.h"
#include "neural/loss/loss.h"
#include "neural/network/make_network.h"
#include "neural/optimise/optimiser.h"
#include "neural/picture.h"
#include "neural/settings.h"

namespace gramloom::neural {
namespace {

at::Tensor noise(std::int64_t channels, std::int64_t side) {
  Random random(1);
  at::Tensor planes = at::empty({channels, side, side}, at::kFloat);
  float* values = planes.data_ptr<float>();
  for (std::int64_t i = 0; i < planes.numel(); ++i) values[i] = random.normal();
  return planes;
}

void use_all_threads() { at::set_num_threads(thread_count()); }

void evaluation(benchmark::State& state, const char* name) {
  use_all_threads();
  const c10::NoGradGuard no_gradients;
  NeuralParams params = with_preset(Preset::gatys);
  params.network = name;
  auto description = read_network(find_network(params.network));
  const auto layers = matched_layers(params, description);
  const at::Tensor exemplar = noise(3, state.range(0)), picture = noise(3, state.range(0));
  const Network network = make_network(params, description, exemplar);
  const Edges edges;
  const Size size{static_cast<int>(state.range(0)), static_cast<int>(state.range(0))};
  const MatchedNetwork matched{network, description, layers};
  Loss loss(params, &matched, exemplar, edges, {size, Tile::both}, edges, Random(1));
  at::Tensor gradient = at::empty_like(picture);
  for (auto _ : state) benchmark::DoNotOptimize(loss(picture, 0, gradient));
}

// A step of the preset `balanced`: patches along random directions.
void sliced(benchmark::State& state) {
  use_all_threads();
  const c10::NoGradGuard no_gradients;
  const Size size{static_cast<int>(state.range(0)), static_cast<int>(state.range(0))};
  const at::Tensor exemplar = noise(3, state.range(0)), picture = noise(3, state.range(0));
  const Edges edges;
  Loss loss(with_preset(Preset::balanced), nullptr, exemplar, edges, {size, Tile::both}, edges,
            Random(1));
  at::Tensor gradient = at::empty_like(picture);
  std::uint64_t step = 0;
  for (auto _ : state) benchmark::DoNotOptimize(loss(picture, step++, gradient));
}

void gram(benchmark::State& state) {
  use_all_threads();
  const c10::NoGradGuard no_gradients;
  const FeatureMaps maps = to_maps(noise(state.range(0), state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(moments(maps).gram);
}

// A sum of squares costs next to nothing: what is left is the optimiser.
void lbfgs(benchmark::State& state) {
  use_all_threads();
  const c10::NoGradGuard no_gradients;
  const at::Tensor scale = noise(3, state.range(0)).abs().add_(0.1);
  const Objective bowl = [&](const at::Tensor& x, at::Tensor& gradient) {
    at::mul_out(gradient, x, scale);
    return 0.5 * at::dot(x.view(-1), gradient.view(-1)).item<double>();
  };
  at::Tensor x = noise(3, state.range(0));
  Lbfgs method(20);
  for (auto _ : state) benchmark::DoNotOptimize(method.step(x, bowl));
}

#define GRAMLOOM_SIZES Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK_CAPTURE(evaluation, multiscale, "multiscale")
    ->Arg(128)
    ->Arg(256)
    ->Arg(512)
    ->GRAMLOOM_SIZES;
BENCHMARK_CAPTURE(evaluation, vgg_small, "vgg_small")->Arg(128)->Arg(256)->Arg(512)->GRAMLOOM_SIZES;
BENCHMARK_CAPTURE(evaluation, vgg19, "vgg19")->Arg(128)->Arg(256)->Arg(512)->GRAMLOOM_SIZES;
BENCHMARK(sliced)->Arg(128)->Arg(256)->Arg(512)->GRAMLOOM_SIZES;
BENCHMARK(gram)->Args({64, 256})->Args({128, 256})->Args({512, 32})->GRAMLOOM_SIZES;
BENCHMARK(lbfgs)->Arg(128)->Arg(256)->Arg(512)->GRAMLOOM_SIZES;

}  // namespace
}  // namespace gramloom::neural
