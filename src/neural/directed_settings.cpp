#include "neural/directed_settings.h"

#include <algorithm>

#include "core/error.h"

namespace gramloom::neural {

std::string_view directed_by(const RequestSize& request) {
  if (request.known) return "known pixels";
  if (request.weights) return "weights";
  if (request.guide) return "a guide";
  if (request.exemplars.size() > 1) return "several exemplars";
  if (std::ranges::any_of(request.exemplars, &ExemplarSize::mask)) return "a mask";
  return {};
}

NeuralParams directed_settings(const NeuralParams& params, const RequestSize& request,
                               bool one_mix) {
  const std::string_view what = directed_by(request);
  if (what.empty()) return params;
  NeuralParams result = params;
  const NeuralParams preset = with_preset(params.preset);
  if (params.spectrum_weight == preset.spectrum_weight) result.spectrum_weight = 0;
  for_each_term(result, [&]<class Term>(const Term&) {
    if (!std::is_same_v<Term, SlicedParams>)
      throw ConfigError(
          "{0}_weight cannot be honoured with {1}: neural honours {1} by patches alone, so set it "
          "to 0 (and sliced_weight above 0)",
          Term::name, what);
  });
  if (result.sliced_weight == 0)
    throw ConfigError("sliced_weight is 0: neural honours {} by patches alone", what);
  const bool directs = request.known || request.guide || request.weights;
  if (directs && params.match_histogram)
    throw ConfigError(
        "match_histogram cannot be honoured with {}: parts of the exemplar's histogram are wanted "
        "there",
        what);
  if (request.known && params.originality != preset.originality)
    throw ConfigError("originality has no effect with {}: all of the exemplar is looked at", what);
  if (!request.weights || !one_mix) return result;
  if (params.layout == Layout::flow)
    throw ConfigError(
        "layout = \"flow\" cannot be honoured with weights that are the same everywhere, as its "
        "patches are of one exemplar or "
        "the other: leave it out");
  result.layout = Layout::noise;
  return result;
}

bool has_one_mix(const Target& target) {
  const auto channels = static_cast<std::size_t>(target.weights.channels);
  for (std::size_t i = channels; i < target.weights.pixels.size(); ++i)
    if (target.weights.pixels[i] != target.weights.pixels[i % channels]) return false;
  return !target.weights.empty();
}

Size smallest_exemplar(const RequestSize& request) {
  Size smallest = request.exemplars.front().size;
  for (const ExemplarSize& exemplar : request.exemplars) {
    smallest.width = std::min(smallest.width, exemplar.size.width);
    smallest.height = std::min(smallest.height, exemplar.size.height);
  }
  return smallest;
}

Size joined_exemplars(const RequestSize& request) {
  Size joined{static_cast<int>(request.exemplars.size()) - 1, 0};
  for (const ExemplarSize& exemplar : request.exemplars) {
    joined.width += exemplar.size.width;
    joined.height = std::max(joined.height, exemplar.size.height);
  }
  return joined;
}

}  // namespace gramloom::neural
