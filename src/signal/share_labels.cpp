#include "signal/share_labels.h"

#include <algorithm>
#include <limits>
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
  // Shares are of what is made.
  std::vector<float> made;
  for (std::size_t i = 0; i < field.pixels.size(); ++i)
    if (target.mask.empty() || target.mask.pixels[i] > 0.5f) made.push_back(field.pixels[i]);
  std::ranges::sort(made);
  const std::vector<float>& weights = target.weights.pixels;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<float> ends;  // of each exemplar's part of the field
  double until = 0;
  for (const float weight : weights) {
    until += double{weight} / all * static_cast<double>(made.size());
    const auto end = static_cast<std::size_t>(until + 0.5);
    ends.push_back(end < made.size() ? made[end] : std::numeric_limits<float>::infinity());
  }
  Image labels(target.size, static_cast<int>(weights.size()), 0.0f);
  for (std::size_t i = 0; i < field.pixels.size(); ++i) {
    std::size_t exemplar = 0;
    while (field.pixels[i] >= ends[exemplar] && exemplar + 1 < ends.size()) ++exemplar;
    labels.pixels[i * weights.size() + exemplar] = 1;
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
