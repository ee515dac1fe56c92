#include "surface/tiling.h"

#include <algorithm>

#include "surface/stochastic_tiling.h"

namespace gramloom {

Texture synthesise(const TilingParams& params, const Request& request, const Control& control) {
  check_request<TilingParams>(request);
  check_fields(params);
  const Target& target = request.target;
  control.step(0, target.size.height);
  const StochasticTiling tiling(request.exemplars.front(), params, target.size, target.tile,
                                request.random);
  Image result(target.size, tiling.channels());
  constexpr int rows_a_step = 64;
  for (int y = 0; y < target.size.height; y += rows_a_step) {
    control.step(y, target.size.height);
    tiling.rows(y, std::min(rows_a_step, target.size.height - y), target.size.width,
                result.at(0, y));
  }
  control.step(target.size.height, target.size.height);
  return {std::move(result)};
}

Cost estimate(const TilingParams& params, const RequestSize& request) {
  check_request<TilingParams>(request);
  const ExemplarSize& exemplar = request.exemplars.front();
  make_lattice(params, exemplar.size, request.size, request.tile, Random(1));  // it may refuse
  const double in = static_cast<double>(exemplar.size.width) * exemplar.size.height;
  const double out = static_cast<double>(request.size.width) * request.size.height;
  // Four copies, one sorted channel, and which pixels count.
  const double bytes_in = 4.0 * exemplar.channels * 4 + 40;
  const double seconds_out = params.rotation > 0 ? 5e-7 : 5e-8;
  return {
      in * bytes_in + 4 * exemplar.channels * out,
      {.serial = 1.2e-7 * in * exemplar.channels, .shared = seconds_out * exemplar.channels * out}};
}

}  // namespace gramloom
