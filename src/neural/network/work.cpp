#include "neural/network/work.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gramloom {

namespace {

// Measured on two cores: what oneDNN gains for 3×3 filters.
constexpr double winograd_gain = 2.2;
constexpr double copied_rows = 1.1;  // values of rows, of which filters see copies without a rim

// How far the maps of some rows reach.
struct Reach {
  double rim = 0;  // rows of the picture above and below that they depend on
  double row = 1;  // rows of the picture that a row of the smallest maps stands for
};

// Feature maps of a large picture are computed twice, a few rows at a time, each time with the rows
// around them.
void a_few_rows_at_a_time(NetworkWork& work, const Reach& reach, Size picture) {
  const double times =
      std::floor(std::min(std::ceil(static_cast<double>(picture.width) * picture.height /
                                    static_cast<double>(most_positions_at_once)),
                          picture.height / reach.row));
  if (times <= 1) return;
  const double share = std::min(1.0, 1 / times + 2 * reach.rim / picture.height);
  for (double* done : {&work.filters, &work.products, &work.products_within_scales, &work.values})
    *done *= 1.5 * share * times;
  for (double* values : {&work.kept, &work.largest, &work.matched})
    *values *= std::min(1.0, share * copied_rows);
}

}  // namespace

NetworkWork network_work(const NetworkDescription& network, const std::vector<FilterShape>& shapes,
                         const std::vector<MatchedLayer>& matched, Size picture, int channels) {
  NetworkWork work;
  Reach reach;
  // Of each size that a pyramid looks at; else of the picture alone.
  std::vector<double> positions{static_cast<double>(picture.width) * picture.height};
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
        work.filters += 4 * static_cast<double>(shape.parameters()) * positions[k] /
                        (winograd ? winograd_gain : 1);
        filters[k] += shape.outputs;
      }
      ++branch;
    }
    if (branch > 0) maps = filters;
    double values = 0, products = 0, within_scales = 0, so_far = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      if (branch == 0 && !std::holds_alternative<ReluLayer>(kind))
        positions[k] = std::floor(positions[k] / 4);
      so_far += maps[k];
      values += maps[k] * positions[k];
      products += maps[k] * so_far * positions[k];
      within_scales += maps[k] * maps[k] * positions[k];
    }
    for (const auto& layer : matched)
      if (layer.index == i) {
        work.products += products;
        work.products_within_scales += within_scales;
        work.matched += values;
        work.positions += std::accumulate(positions.begin(), positions.end(), 0.0);
      }
    if (std::holds_alternative<ReluLayer>(kind)) continue;  // done with the layer before
    work.kept += values;
    work.values += values;
    work.largest = std::max(work.largest, values);
    if (pyramid) {  // whose rows reach as far as its scales are averaged over each other
      reach.row = std::pow(2.0, static_cast<double>(positions.size()) - 1);
      reach.rim = 2 * reach.row;
    }
    double radius = 0;
    for (const auto& shape : shapes)
      if (shape.layer == i && !pyramid)
        radius = std::max(radius, shape.kernel / 2 * shape.dilation + std::ceil(3 * shape.blur));
    reach.rim += radius * reach.row;
    if (branch == 0) reach.row *= 2;
  }
  a_few_rows_at_a_time(work, reach, picture);
  return work;
}

}  // namespace gramloom
