#include "classic/pixel.h"

#include <algorithm>
#include <cmath>

#include "classic/known_pixels.h"
#include "classic/pixel_algorithms.h"
#include "core/error.h"
#include "signal/fill_windows.h"
#include "signal/share_labels.h"
#include "signal/united.h"

namespace gramloom {
namespace {

pixel::Canvas sources(const PixelParams& params, const pixel::Task& task, Random random,
                      const Control& control) {
  switch (params.algorithm) {
    case PixelAlgorithm::efros_leung:
      return pixel::efros_leung(params, task, random, control);
    case PixelAlgorithm::wei_levoy:
      return pixel::wei_levoy(params, task, random, control);
    case PixelAlgorithm::lefebvre_hoppe:
      break;
  }
  return pixel::lefebvre_hoppe(params, task, random, control);
}

/// What one of the algorithms cannot do.
void check_algorithm(const PixelParams& params, const RequestSize& request) {
  if (params.algorithm == PixelAlgorithm::wei_levoy && request.known)
    throw Error(
        "pixel with algorithm = \"wei_levoy\" cannot fill, since it chooses pixels in scan order: "
        "a "
        "target's mask is given (lefebvre_hoppe and efros_leung can)");
}

Texture synthesise_whole(const PixelParams& params, const Request& asked, const Control& control) {
  const std::optional<Request> labelled = with_labels(asked);
  const Request& request = labelled ? *labelled : asked;
  const United united(request);
  const Target& target = request.target;
  const ExemplarQuota quota(request, united);
  const pixel::Task task{united.exemplar(),
                         target.size,
                         target.tile,
                         target.known,
                         target.mask,
                         quota.guide(united),
                         target.guide_weight,
                         united.guide().channels - target.guide.channels,
                         quota,
                         same_picture(request) == std::size_t{0}};
  SourceMap source = pixel::sources_of(sources(params, task, request.random, control));
  united.name_sources(source);
  Texture texture = texture_of(std::move(source), request.exemplars);
  keep_known(texture.image, target);
  return texture;
}

}  // namespace

Texture synthesise(const PixelParams& params, const Request& request, const Control& control) {
  check_fields(params);
  check_request<PixelParams>(request);
  check_algorithm(params, size_of(request));
  const std::vector<FillWindow> windows = fill_windows(request, 0.7);  // what costs is the exemplar
  if (windows.empty()) return synthesise_whole(params, request, control);
  return fill_by_windows(
      request, windows,
      [&](const Request& part, const Control& own) { return synthesise_whole(params, part, own); },
      control);
}

Cost estimate(const PixelParams& params, const RequestSize& request) {
  check_request<PixelParams>(request);
  check_algorithm(params, request);
  const int channels = request.exemplars.front().channels;
  double from = 0;
  for (const ExemplarSize& exemplar : request.exemplars)
    from += static_cast<double>(exemplar.size.width) * exemplar.size.height;
  const double to = static_cast<double>(request.size.width) * request.size.height;
  const double compared = std::min(channels, 4);
  const double candidates = params.candidates;
  const double window = std::pow(2 * params.radius + 1, 2);

  Cost cost;
  // Levels, features and lists of like samples while they are made; canvases, colours and result.
  cost.bytes = from * (6 * channels + 6 * compared + 38 + 20 * candidates) +
               to * (4 * channels + 4 * compared + 6 + sizeof(Source)) + 5e6;
  // The joined picture, and known pixels, guides and weights on all levels.
  if (request.exemplars.size() > 1 || request.exemplars.front().mask)
    cost.bytes += from * 4 * channels;
  if (request.known) cost.bytes += to * (4 * channels + 8 * compared);
  if (request.guide || request.weights) cost.bytes += 32 * (from + to);
  if (request.weights)  // labels, and a copy of the request
    cost.bytes +=
        from * 4 * channels + to * (8 + 4.0 * static_cast<double>(request.exemplars.size()));
  // Lists of like samples take more the more there are to look through.
  const double lists = 1.4e-6 * candidates * from * std::pow(from / 65536, 0.3);
  const double made = to * request.made;
  const double trials = params.algorithm == PixelAlgorithm::lefebvre_hoppe ? params.passes : 1;
  if (params.search == PixelSearch::exact)
    cost.work.shared = trials * made * from * window * compared / 1e10;
  else if (params.algorithm == PixelAlgorithm::lefebvre_hoppe)
    cost.work.shared = lists + 3.5e-7 * trials * candidates * made;
  else
    cost.work.shared = lists + 6e-8 * window * candidates * made;
  // The first blocks of holes, each compared with all places of its window.
  if (request.known && params.algorithm == PixelAlgorithm::lefebvre_hoppe)
    cost.work.shared += made / 64 * std::min(from, 1e5) * compared * 1.8e-8;
  return cost;
}

}  // namespace gramloom
