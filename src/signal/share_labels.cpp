#include "signal/share_labels.h"

#include <algorithm>
#include <numeric>

#include "signal/blur.h"

namespace gramloom {

namespace {

constexpr double island_deviation = 12;                             // pixels
constexpr std::uint64_t stream_of_labels = std::uint64_t{1} << 32;  // none that methods have

}  // namespace

Image labels_of_shares(const Target& target, Random random) {
  Image field(target.size, 1);
  for (float& value : field.pixels) value = random.uniform();
  field = blurred(field, island_deviation, target.tile);
  std::vector<std::size_t> order(field.pixels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const float u = field.pixels[a], v = field.pixels[b];
    return u != v ? u < v : a < b;
  });
  const std::vector<float>& weights = target.weights.pixels;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  Image labels(target.size, static_cast<int>(weights.size()), 0.0f);
  double until = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    until += double{weights[i]} / all * static_cast<double>(order.size());
    const auto end = i + 1 == weights.size() ? order.size() : static_cast<std::size_t>(until + 0.5);
    for (; next < end; ++next) labels.pixels[order[next] * weights.size() + i] = 1;
  }
  return labels;
}

std::optional<Request> with_labels(const Request& request) {
  if (request.exemplars.size() < 2 || request.target.weights.size() != Size{1, 1})
    return std::nullopt;
  Request labelled = request;
  labelled.target.weights =
      labels_of_shares(request.target, request.random.stream(stream_of_labels));
  return labelled;
}

}  // namespace gramloom
