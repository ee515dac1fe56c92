#include <algorithm>
#include <cmath>

#include "core/threads.h"
#include "neural/directed_settings.h"
#include "neural/settings.h"
#include "neural/settling_cost.h"
#include "neural/synthesis.h"

namespace gramloom {

namespace {

using namespace neural;

// Measured; seconds of one thread.
constexpr double start_seconds = 0.5;  // of the libraries
constexpr double seconds_per_step = 5e-4;
constexpr double seconds_per_value = 1.5e-8;          // of Adam
constexpr double seconds_per_map_value = 1.4e-8;      // of a network, beside its products
constexpr double seconds_per_remembered = 3e-10;      // value of L-BFGS
constexpr double evaluations_per_step = 1.1;          // of L-BFGS
constexpr double seconds_per_pixel_of_fill = 7.5e-7;  // known or made, in a step of a layout
constexpr double pictures_of_fill = 12;
constexpr double whole_pictures = 2;          // beside those of a fill's window
constexpr double directed_patches = 2.5;      // seconds, where each has its own place and goal
constexpr double optimiser_values = 9;        // in memory, for each of the picture's
constexpr double bytes_of_patch = 235;        // of an exemplar, in a layout
constexpr double most_patches = 512.0 * 512;  // that a layout looks at
constexpr double packed_bytes = 8e6;          // a thread: oneDNN's packed matrices, most with AVX2

// Which part of a fill's patches is compared: those with a pixel of a hole.
double counted_share(double made) { return std::min(1.0, 1.3 * made + 0.01); }

// What the terms look at on the finest level.
LossSize loss_size(const NeuralParams& params, Size exemplar, Size canvas, int channels) {
  LossSize size{area(exemplar), area(canvas), channels, params.directions, {}, {}};
  if (!needs_network(params)) return size;
  auto network = read_network(find_network(params.network));
  const auto layers = matched_layers(params, network);
  const auto shapes = filter_shapes(network, channels);
  size.of_result = network_work(network, shapes, layers, canvas, channels);
  size.of_exemplar = network_work(network, shapes, layers, exemplar, channels);
  return size;
}

// Of one evaluation of all terms: they take turns, but those that look at a network do so together.
LossCost loss_cost(const NeuralParams& params, const LossSize& size) {
  LossCost network{{.shared = size.of_result.values * seconds_per_map_value,
                    .operations = size.of_result.filters},
                   sizeof(float) * 3 * size.of_result.weights +
                       std::max(size.of_result.bytes(), size.of_exemplar.bytes_without_gradient())};
  LossCost pictures;
  for_each_term(params, [&]<class Term>(const Term& term) {
    const LossCost own = cost(term, size);
    (LooksAtNetwork<Term> ? network : pictures).work += own.work;
    if (LooksAtNetwork<Term>)
      network.bytes += own.bytes;
    else
      pictures.bytes = std::max(pictures.bytes, own.bytes);
  });
  return {network.work + pictures.work, network.bytes + pictures.bytes};
}

Work work_of_step(const NeuralParams& params, const Work& evaluation, double values,
                  Optimizer optimizer) {
  const Work work = Work{.serial = seconds_per_step} + evaluation;
  if (optimizer == Optimizer::adam) return work + Work{.shared = values * seconds_per_value};
  return evaluations_per_step * work +
         Work{.shared = values * 4 * params.history * seconds_per_remembered};
}

// One step of the layout: every fourth patch against all references, and the prices' part of them.
Work work_of_flow(const NeuralParams& params, double pixels, double of_exemplar, bool fills) {
  constexpr double dimensions = 48, of_prices = 1.5;
  const auto patches = static_cast<std::int64_t>(of_exemplar);
  const double references =
      fills ? static_cast<double>(
                  std::min(patches, looked_at_for_a_fill(static_cast<std::int64_t>(pixels / 4))))
            : static_cast<double>(params.references(patches, pixels));
  return {.shared = 3e-7 * pixels,
          .operations = of_prices * pixels / 4 * references * dimensions * 2};
}

// All that the synthesis itself would refuse once it has begun.
void check_possible(const NeuralParams& params, const RequestSize& request) {
  check_settings(params);
  const Size exemplar = smallest_exemplar(request);
  const int channels = request.exemplars.front().channels;
  const Target target{request.size, request.tile};
  if (params.sliced_weight > 0)
    check_patches_fit(params.patch_sizes, exemplar, target.size, target.tile);
  if (!params.start.empty()) read_start(params, channels);
  if (!needs_network(params)) {
    check_levels(params, nullptr, exemplar, target);
    return;
  }
  auto network = read_network(find_network(params.network));
  matched_layers(params, network);
  check_weights(params, network, channels);
  check_levels(params, &network, exemplar, target);
  if (!params.weights.empty())
    read_weights(network, filter_shapes(network, channels), params.weights);
}

// What is left of a fill in its window.
RequestSize of_window(RequestSize request) {
  for (ExemplarSize& exemplar : request.exemplars)
    if (exemplar.filled) exemplar.size = request.around;
  request.made *= area(request.size) / area(request.around);
  request.size = request.around;
  request.around = {};
  return request;
}

}  // namespace

Cost estimate(const NeuralParams& asked, const RequestSize& request) {
  check_request<NeuralParams>(request);
  if (fills_window(asked, request)) {
    Cost cost = estimate(asked, of_window(request));
    cost.bytes += sizeof(float) * whole_pictures * request.exemplars.front().channels *
                  (area(request.size) + area(joined_exemplars(request)));
    return cost;
  }
  const Size exemplar = smallest_exemplar(request);
  const int channels = request.exemplars.front().channels;
  const Target target{request.size, request.tile};
  NeuralParams params = directed_settings(asked, request, false);
  params.layout = layout_by_size(params, exemplar, target);
  check_possible(params, request);
  const Size canvas = request.known ? target.size : canvas_size(params, target);
  LossSize size = loss_size(params, joined_exemplars(request), canvas, channels);
  if (request.known) size.result *= counted_share(request.made);
  LossSize compared = size;  // each patch with one of the exemplar's
  if (request.known || request.guide) compared.exemplar = size.result;
  LossCost loss = loss_cost(params, compared);
  if (request.known || request.guide || request.weights) loss.work = directed_patches * loss.work;
  const bool remembers = std::find(params.optimizer.begin(), params.optimizer.end(),
                                   Optimizer::lbfgs) != params.optimizer.end();
  // A checkpoint is put together in memory: all that the optimiser keeps is there once more.
  const double kept = size.values() * 2 * (remembers ? 2.0 * params.history : 2.0);
  Cost cost;
  cost.bytes = loss.bytes + sizeof(float) * (kept + optimiser_values * size.values() +
                                             4 * size.exemplar * channels);
  if (params.layout == Layout::flow)  // vectors of patches and their neighbours, and pictures
    cost.bytes =
        std::max(cost.bytes, size.result * (48 * (1 + 2 * params.remembered()) + 40) +
                                 sizeof(float) * channels * (8 * size.result + 8 * size.exemplar) +
                                 bytes_of_patch * std::min(size.exemplar, most_patches));
  cost.bytes += packed_bytes * thread_count();
  if (request.known)  // pictures and masks of the whole, most of which stays
    cost.bytes += sizeof(float) * pictures_of_fill * channels * canvas.width * canvas.height;
  cost.work = {.serial = start_seconds, .operations = size.of_exemplar.filters / 2};
  for (int level = 0; level < level_count(params, exemplar, target); ++level) {
    const bool flow = params.layout == Layout::flow;
    const double area = std::pow(flow ? 0.5 : params.level_factor, 2 * level);
    if (flow)
      cost.work += at_level(params.flow_steps, level) *
                   work_of_flow(params, size.result * area, size.exemplar * area, request.known);
    if (flow && request.known)
      cost.work.shared += at_level(params.flow_steps, level) * area * canvas.width * canvas.height *
                          seconds_per_pixel_of_fill;
    cost.work += at_level(params.iterations, level) *
                 work_of_step(params, area * loss.work, size.values() * area,
                              at_level(params.optimizer, level));
  }
  if (channels != 1 && channels != 3)  // maps, it may be
    cost.work.operations += settling_operations(1.0 * target.size.width * target.size.height);
  return cost;
}

}  // namespace gramloom
