#include <algorithm>
#include <cmath>
#include <numeric>

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
constexpr double seconds_per_transformed_value = 5e-8;
constexpr double seconds_per_step = 5e-4;
constexpr double copied_rows = 1.5;  // values of a band, of which filters see copies without a rim

struct Work {
  double operations = 0;  // of one evaluation with its gradient
  double kept = 0;        // values that the gradient needs
  double largest = 0;     // values of the largest layer
  double matched = 0;     // values of the matched layers
  double positions = 0;   // of the matched layers
  double halo = 0;        // rows of the picture above and below, that a band of maps depends on
  double row = 1;         // rows of the picture that a row of the smallest maps stands for
  double weights = 0;
};

Work count(const NetworkDescription& network, const std::vector<FilterShape>& shapes,
           const std::vector<MatchedLayer>& matched, Size size, int channels) {
  Work work;
  // Of each size that a pyramid looks at; else of the picture alone.
  std::vector<double> positions{static_cast<double>(size.width) * size.height};
  if (const auto* pyramid = std::get_if<PyramidLayer>(&network.layers[0].kind))
    while (positions.size() < static_cast<std::size_t>(pyramid->scales))
      positions.push_back(positions.back() / 4);
  std::vector<double> maps(positions.size(), channels);
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    const auto& kind = network.layers[i].kind;
    const bool pyramid = std::holds_alternative<PyramidLayer>(kind);
    std::vector<double> filters(positions.size(), 0);  // of this layer
    std::size_t branch = 0;
    for (const auto& shape : shapes) {
      if (shape.layer != i) continue;
      const bool winograd = shape.kernel == 3 && shape.dilation == 1 && shape.inputs >= 16;
      work.weights += static_cast<double>(shape.parameters());
      for (std::size_t k = 0; k < positions.size(); ++k) {
        if (pyramid && k != branch) continue;
        work.operations += 4 * static_cast<double>(shape.parameters()) * positions[k] /
                           (winograd ? winograd_gain : 1);
        filters[k] += shape.outputs;
      }
      ++branch;
    }
    if (branch > 0) maps = filters;
    double values = 0, products = 0, so_far = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      if (branch == 0 && !std::holds_alternative<ReluLayer>(kind))
        positions[k] = std::floor(positions[k] / 4);
      so_far += maps[k];
      values += maps[k] * positions[k];
      products += maps[k] * so_far * positions[k];  // with all finer sizes
    }
    for (const auto& layer : matched)
      if (layer.index == i) {
        work.operations += 4 * products;
        work.matched += values;
        work.positions += std::accumulate(positions.begin(), positions.end(), 0.0);
      }
    if (std::holds_alternative<ReluLayer>(kind)) continue;  // done with the layer before
    work.kept += values;
    work.largest = std::max(work.largest, values);
    if (pyramid) {  // whose bands reach as far as its scales are averaged over each other
      work.row = std::pow(2.0, static_cast<double>(positions.size()) - 1);
      work.halo = 2 * work.row;
    }
    double radius = 0;
    for (const auto& shape : shapes)
      if (shape.layer == i && !pyramid)
        radius = std::max(radius, shape.kernel / 2 * shape.dilation + std::ceil(3 * shape.blur));
    work.halo += radius * work.row;
    if (branch == 0) work.row *= 2;
  }
  return work;
}

// Feature maps of a large picture are in memory band by band, and computed twice, each time with
// the rows around the band.
void in_bands(Work& work, Size size) {
  const double bands = std::floor(std::min(std::ceil(static_cast<double>(size.width) * size.height /
                                                     static_cast<double>(most_positions_in_band)),
                                           size.height / work.row));
  if (bands <= 1) return;
  const double share = std::min(1.0, 1 / bands + 2 * work.halo / size.height);
  work.operations *= 1.5 * share * bands;
  for (double* values : {&work.kept, &work.largest, &work.matched})
    *values *= std::min(1.0, share * copied_rows);
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
  const double at_once = std::min(static_cast<double>(params.directions),
                                  std::max(static_cast<double>(least_directions_at_once),
                                           static_cast<double>(sliced_values_at_once) / larger));
  const double keys = 16 * larger * std::min<double>(thread_count(), at_once);
  work.bytes = sizeof(float) * 2 * at_once * larger + keys;
  return work;
}

// Values in memory, for each of the picture's, beside those of the optimiser: the terms that look
// at the whole picture take its Fourier transform or differences, the spectrum channel by channel.
double values_of_picture(const NeuralParams& params, int channels) {
  if (params.autocorrelation_weight + params.variation_weight > 0) return 40;
  return params.spectrum_weight > 0 ? 10 + 25.0 / channels : 9;
}

// Where a level's evaluations go.
double seconds_of_step(const NeuralParams& params, const Work& network, const SlicedWork& sliced,
                       double picture, Optimizer optimizer) {
  double seconds = seconds_per_step + sliced.operations / sliced_operations_per_second +
                   sliced.sorted * seconds_per_sorted_value +
                   network.operations / operations_per_second;
  const double transforms = params.spectrum_weight + params.autocorrelation_weight;
  if (transforms + params.variation_weight > 0) seconds += picture * seconds_per_transformed_value;
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
  SlicedWork features;
  if (needs_network(params)) {
    auto network = read_network(find_network(params.network));
    const auto layers = matched_layers(params, network);
    check_weights(params, network, channels);
    const auto shapes = filter_shapes(network, channels);
    result = count(network, shapes, layers, canvas, channels);
    own = count(network, shapes, layers, exemplar, channels);
    in_bands(result, canvas);
    in_bands(own, exemplar);
    if (params.sliced_features_weight > 0) {  // projections of both pictures, sorted in each step
      features.sorted = params.directions * (result.positions + own.positions);
      features.operations = own.operations / 2;
      features.bytes = 3 * sizeof(float) * features.sorted;
    }
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
      sliced.bytes + features.bytes +
      sizeof(float) *
          (3 * result.weights +
           std::max(1.5 * result.kept + 5 * result.largest, own.kept + 3 * own.largest) + 2 * kept +
           values_of_picture(params, channels) * picture + 4 * pixels(exemplar) * channels);
  cost.seconds = start_seconds + own.operations / 2 / operations_per_second;
  for (int level = 0; level < level_count(params, exemplar, target); ++level) {
    const double area = std::pow(params.level_factor, 2 * level);
    const Work part{result.operations * area, 0, 0, 0, 0};
    const SlicedWork share{(sliced.operations + features.operations) * area,
                           (sliced.sorted + features.sorted) * area, 0};
    cost.seconds +=
        at_level(params.iterations, level) *
        seconds_of_step(params, part, share, picture * area, at_level(params.optimizer, level));
  }
  return cost;
}

}  // namespace gramloom
