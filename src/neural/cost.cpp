#include <algorithm>
#include <cmath>

#include "neural/settings.h"
#include "neural/synthesis.h"

namespace gramloom {

namespace {

using namespace neural;

// Measured on two cores: what oneDNN and OpenBLAS reach over a whole evaluation, the start of the
// libraries, and the memory of the process with nothing in it.
constexpr double operations_per_second = 2.2e11;
constexpr double winograd_gain = 2.2;
constexpr double start_seconds = 0.5;
constexpr double evaluations_per_step = 1.1;

struct Work {
  double operations = 0;  // of one evaluation with its gradient
  double kept = 0;        // values that the gradient needs
  double largest = 0;     // values of the largest layer
  double weights = 0;
};

Work count(const NetworkDescription& network, const std::vector<FilterShape>& shapes,
           const std::vector<Loss::MatchedLayer>& matched, Size size, int channels) {
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
      if (layer.index == i) work.operations += 6 * maps * std::max(values, maps * positions) / 1.5;
  }
  return work;
}

}  // namespace

Cost estimate(const NeuralParams& params, Size exemplar, int channels, const Target& target) {
  auto network = read_network(find_network(params.network));
  const auto layers = matched_layers(params, network);
  check_weights(params, network, channels);
  const auto shapes = filter_shapes(network, channels);
  const Work result = count(network, shapes, layers, target.size, channels);
  const Work own = count(network, shapes, layers, exemplar, channels);
  const double picture = static_cast<double>(target.size.width) * target.size.height * channels;
  Cost cost;
  cost.bytes = sizeof(float) *
               (3 * result.weights +
                std::max(1.5 * result.kept + 5 * result.largest, own.kept + 3 * own.largest) +
                (2 * params.history + 8) * picture);
  double area = 0;  // of all levels, in finest ones
  for (int level = 0; level < params.levels; ++level)
    area += std::pow(params.level_factor, 2 * level);
  cost.seconds = start_seconds + own.operations / 2 / operations_per_second +
                 area * params.iterations * evaluations_per_step *
                     (result.operations / operations_per_second +
                      picture * (4 * params.history) * 2e-10 + 2e-3);
  return cost;
}

}  // namespace gramloom
