#include "classic/pixel.h"

#include <algorithm>
#include <cmath>

#include "classic/pixel_algorithms.h"

namespace gramloom {
namespace {

pixel::Canvas sources(const PixelParams& params, const Image& exemplar, const Target& target,
                      Random random, const Control& control) {
  switch (params.algorithm) {
    case PixelAlgorithm::efros_leung:
      return pixel::efros_leung(params, exemplar, target, random, control);
    case PixelAlgorithm::wei_levoy:
      return pixel::wei_levoy(params, exemplar, target, random, control);
    case PixelAlgorithm::lefebvre_hoppe:
      break;
  }
  return pixel::lefebvre_hoppe(params, exemplar, target, random, control);
}

}  // namespace

Texture synthesise(const PixelParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<PixelParams>(request);
  const Image& exemplar = request.exemplars.front().image;
  const Target& target = request.target;
  return texture_of(pixel::sources_of(sources(params, exemplar, target, request.random, control)),
                    request.exemplars);
}

Cost estimate(const PixelParams& params, const RequestSize& request) {
  check_request<PixelParams>(request);
  const Size exemplar = request.exemplars.front().size;
  const int channels = request.exemplars.front().channels;
  const double from = static_cast<double>(exemplar.width) * exemplar.height;
  const double to = static_cast<double>(request.size.width) * request.size.height;
  const double compared = std::min(channels, 4);
  const double candidates = params.candidates;
  const double window = std::pow(2 * params.radius + 1, 2);

  Cost cost;
  // Levels, features and lists of like samples while they are made; canvases, colours and result.
  cost.bytes = from * (8 * channels + 16 * compared + 64 + 20 * candidates + 8) +
               to * (4 * channels + 4 * compared + 40 + sizeof(Source)) + 5e6;
  // Fitted to runs on two cores.
  const double trials = params.algorithm == PixelAlgorithm::lefebvre_hoppe ? params.passes : 1;
  if (params.search == PixelSearch::exact)
    cost.seconds = trials * to * from * window * compared / 1e10;
  else if (params.algorithm == PixelAlgorithm::lefebvre_hoppe)
    cost.seconds = 1e-6 * candidates * from + 1.3e-7 * trials * candidates * to;
  else
    cost.seconds = 1e-6 * candidates * from + 6e-8 * window * candidates * to;
  return cost;
}

}  // namespace gramloom
