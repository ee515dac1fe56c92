#include "classic/phase.h"

#include <algorithm>

#include "core/threads.h"

namespace gramloom {

Texture synthesise(const PhaseParams& params, const Request& request, const Control& control) {
  check_request<PhaseParams>(request);
  const Target& target = request.target;
  control.step(0, 1);
  Image result = random_phase_texture(request.exemplars.front().image, target.size, target.tile,
                                      params.fade, request.random);
  control.step(1, 1);
  return {std::move(result)};
}

Cost estimate(const PhaseParams&, const RequestSize& request) {
  check_request<PhaseParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const double in = static_cast<double>(exemplar.width) * exemplar.height;
  const double out = static_cast<double>(std::max(request.size.width, exemplar.width)) *
                     std::max(request.size.height, exemplar.height);
  const int in_flight = std::min(channels, thread_count());
  // Each channel in flight: its plane, spectrum and the transform's own copy; the phases are
  // shared.
  return {4 * channels * (in + out) + in_flight * 24 * out + 4 * out, channels * 5e-8 * out};
}

}  // namespace gramloom
