#include "classic/phase.h"

#include <algorithm>

#include "core/threads.h"

namespace gramloom {

Texture synthesise(const PhaseParams& params, const Request& request, const Control& control) {
  check_request<PhaseParams>(request);
  const Target& target = request.target;
  control.step(0, 1);
  Image result = random_phase_texture(request.exemplars, target.weights, target.size, target.tile,
                                      params.fade, request.random);
  control.step(1, 1);
  return {std::move(result)};
}

Cost estimate(const PhaseParams&, const RequestSize& request) {
  check_request<PhaseParams>(request);
  const int channels = request.exemplars.front().channels;
  Size period = request.size;
  double in = 0;
  for (const ExemplarSize& exemplar : request.exemplars) {
    in += static_cast<double>(exemplar.size.width) * exemplar.size.height;
    period = {std::max(period.width, exemplar.size.width),
              std::max(period.height, exemplar.size.height)};
  }
  const double out = static_cast<double>(period.width) * period.height;
  const auto exemplars = static_cast<double>(request.exemplars.size());
  const int in_flight = std::min(channels, thread_count());
  // Each channel in flight: its plane, spectrum and the transform's own copy; the phases are
  // shared.
  return {4 * channels * (in + out) + in_flight * 24 * out + 4 * out,
          {.shared = exemplars * channels * 8e-8 * out}};
}

}  // namespace gramloom
