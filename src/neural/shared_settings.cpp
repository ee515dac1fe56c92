#include <algorithm>
#include <cmath>

#include "neural/directed_settings.h"
#include "neural/settings.h"
#include "neural/shared_synthesis.h"

namespace gramloom {

namespace {

// Terms that are sums over positions, or histograms of them.
template <class Term>
constexpr bool is_of_rows = std::is_same_v<Term, GramParams> || std::is_same_v<Term, SlicedParams>;

}  // namespace

void neural::check_shared(const NeuralParams& params, const RequestSize& request, int processes) {
  if (const std::string_view what = directed_by(request); !what.empty())
    throw ConfigError("{} cannot be honoured by several processes together", what);
  for_each_term(params, [&]<class Term>(const Term&) {
    if (!is_of_rows<Term>)
      throw ConfigError(
          "{0}_weight cannot be honoured by several processes together, as it looks at the whole "
          "picture at once: set it to 0",
          Term::name);
  });
  if (params.match_histogram)
    throw ConfigError(
        "match_histogram cannot be honoured by several processes together, as it sorts the whole "
        "picture: set it to false");
  const Target target{request.size, request.tile};
  if (layout_by_size(params, smallest_exemplar(request), target) == Layout::flow)
    throw ConfigError(
        "a layout by flow cannot be made by several processes together: set layout = \"noise\"");
  const Size canvas = canvas_size(params, target);
  if (!is_shared(params, canvas, processes))
    throw ConfigError(
        "a texture of {}×{} is too small to be shared among {} processes: each takes 64 rows or "
        "more, and all together more than positions = {} patches",
        request.size.width, request.size.height, processes, params.positions);
}

Cost estimate_share(const NeuralParams& params, const RequestSize& request, int processes) {
  // Beside its rows, those around them and what comes and goes.
  constexpr double beside = 1.2;
  RequestSize part = request;
  part.size.height = (request.size.height + processes - 1) / processes;
  Cost cost = estimate(params, part);
  cost.bytes *= beside;
  return cost;
}

}  // namespace gramloom
