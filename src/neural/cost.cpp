#include <algorithm>
#include <cmath>

#include "core/threads.h"
#include "neural/settings.h"
#include "neural/synthesis.h"

namespace gramloom {

namespace {

using namespace neural;

// Measured on two cores: what oneDNN and OpenBLAS reach over a whole evaluation, and the start of
// the libraries.
constexpr double operations_per_second = 2.2e11;
constexpr double winograd_gain = 2.2;
constexpr double start_seconds = 0.5;
constexpr double evaluations_per_step = 1.1;
constexpr double sliced_operations_per_second = 1.2e11;
constexpr double seconds_per_sorted_value = 6e-9;
constexpr double seconds_per_step = 5e-4;

struct Work {
  double operations = 0;  // of one evaluation with its gradient
  double kept = 0;        // values that the gradient needs
  double largest = 0;     // values of the largest layer
  double matched = 0;     // values of the matched layers
  double weights = 0;
};

Work count(const NetworkDescription& network, const std::vector<FilterShape>& shapes,
           const std::vector<MatchedLayer>& matched, Size size, int channels) {
  Work work;
  const double pixels = static_cast<double>(size.width) * size.height;
  double positions = pixels, maps = channels;
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    double width = 0, at_scale = pixels;
    const bool pyramid = std::holds_alternative<PyramidLayer>(network.layers[i].kind);
    double values = 0;
    for (const auto& shape : shapes) {
      if (shape.layer != i) continue;
      const double at = pyramid ? at_scale : positions;
      const double multiplications = static_cast<double>(shape.parameters()) * at;
      const bool winograd = shape.kernel == 3 && shape.dilation == 1 && shape.inputs >= 16;
      work.operations += 4 * multiplications / (winograd ? winograd_gain : 1);
      work.weights += static_cast<double>(shape.parameters());
      values += shape.outputs * at;
      width += shape.outputs;
      at_scale /= 4;
    }
    if (width > 0) {
      maps = width;
    } else if (!std::holds_alternative<ReluLayer>(network.layers[i].kind)) {
      positions = std::floor(positions / 4);
      values = maps * positions;
    }
    work.kept += values;
    work.largest = std::max(work.largest, values);
    for (const auto& layer : matched)
      if (layer.index == i) {
        const double matched_values = std::max(values, maps * positions);
        work.operations += 6 * maps * matched_values / 1.5;
        work.matched += matched_values;
      }
  }
  return work;
}

// What is in memory and what is computed for the sliced distance: per step, both pictures are
// projected along each direction, sorted and, one of them, spread again.
struct SlicedWork {
  double operations = 0, sorted = 0;  // of one step
  double bytes = 0;
};

SlicedWork count_sliced(const NeuralParams& params, double result, double exemplar, int channels) {
  SlicedWork work;
  if (params.sliced_weight == 0) return work;
  double taps = 0;
  for (const int side : params.patch_sizes) taps += static_cast<double>(side) * side * channels;
  taps /= static_cast<double>(params.patch_sizes.size());
  work.operations = 2 * taps * params.directions * (2 * result + exemplar);
  work.sorted = params.directions * (result + 0.5 * exemplar);
  const double larger = std::max(result, exemplar);
  const double at_once = std::clamp(static_cast<double>(neural::sliced_values_at_once) / larger,
                                    2.0, std::max(2.0, static_cast<double>(params.directions)));
  const double keys = 16 * larger * std::min<double>(thread_count(), at_once);
  work.bytes = sizeof(float) * 2 * at_once * larger + keys;
  return work;
}

// Whether there are terms that look at the whole picture, by Fourier transforms and differences.
bool looks_at_whole(const NeuralParams& params) {
  return params.spectrum_weight + params.autocorrelation_weight + params.variation_weight > 0;
}

// Where a level's evaluations go.
double seconds_of_step(const NeuralParams& params, const Work& network, const SlicedWork& sliced,
                       double picture, Optimizer optimizer) {
  double seconds = seconds_per_step + sliced.operations / sliced_operations_per_second +
                   sliced.sorted * seconds_per_sorted_value +
                   network.operations / operations_per_second;
  if (looks_at_whole(params)) seconds += picture * 2e-7;
  if (optimizer == Optimizer::adam) return seconds + picture * 1e-8;
  return evaluations_per_step * seconds + picture * (4 * params.history) * 2e-10;
}

}  // namespace

Cost estimate(const NeuralParams& params, Size exemplar, int channels, const Target& target) {
  check_settings(params);
  if (params.sliced_weight > 0)
    check_patches_fit(params.patch_sizes, exemplar, target.size, target.tile);
  const Size canvas = canvas_size(params, target);
  const auto pixels = [](Size size) { return static_cast<double>(size.width) * size.height; };
  Work result, own;
  if (params.gram_weight > 0) {
    auto network = read_network(find_network(params.network));
    const auto layers = matched_layers(params, network);
    check_weights(params, network, channels);
    const auto shapes = filter_shapes(network, channels);
    result = count(network, shapes, layers, canvas, channels);
    own = count(network, shapes, layers, exemplar, channels);
    const double shifted = 1 + 4 * static_cast<double>(params.shifts.size()) / 3;
    result.operations *= shifted;
    // The gradient needs each shifted copy of the maps, and both as rows.
    result.kept += 4 * 3 * static_cast<double>(params.shifts.size()) * result.matched;
  }
  const SlicedWork sliced = count_sliced(params, pixels(canvas), pixels(exemplar), channels);
  const double picture = pixels(canvas) * channels;
  const bool remembers = std::find(params.optimizer.begin(), params.optimizer.end(),
                                   Optimizer::lbfgs) != params.optimizer.end();
  Cost cost;
  // A checkpoint is put together in memory: all that the optimiser keeps is there once more.
  const double kept = picture * (remembers ? 2.0 * params.history : 2.0);
  cost.bytes =
      sliced.bytes +
      sizeof(float) *
          (3 * result.weights +
           std::max(1.5 * result.kept + 5 * result.largest, own.kept + 3 * own.largest) + 2 * kept +
           (looks_at_whole(params) ? 40 : 9) * picture + 4 * pixels(exemplar) * channels);
  cost.seconds = start_seconds + own.operations / 2 / operations_per_second;
  for (int level = 0; level < level_count(params, exemplar, target); ++level) {
    const double area = std::pow(params.level_factor, 2 * level);
    const Work part{result.operations * area, 0, 0, 0, 0};
    const SlicedWork share{sliced.operations * area, sliced.sorted * area, 0};
    cost.seconds +=
        at_level(params.iterations, level) *
        seconds_of_step(params, part, share, picture * area, at_level(params.optimizer, level));
  }
  return cost;
}

}  // namespace gramloom
