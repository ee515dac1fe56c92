#include "surface/maps.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "surface/relief_maps.h"

namespace gramloom {

std::vector<std::string> maps_asked(const MapParams& params) {
  std::vector<std::string> names;
  if (params.normal) names.emplace_back("normal");
  if (params.occlusion) names.emplace_back("occlusion");
  if (params.curvature) names.emplace_back("curvature");
  return names;
}

bool makes_any(const SurfaceParams& params) { return params.guess || !maps_asked(params).empty(); }

std::map<std::string, Image> maps_of_height(const Image& height, const MapParams& params,
                                            Tile wraps) {
  check_fields(params);
  std::map<std::string, Image> maps;
  if (params.normal)
    maps["normal"] =
        normals_to_colours(normals_from_height(height, params.strength, wraps), params.green);
  if (params.occlusion)
    maps["occlusion"] = ambient_occlusion(height, params.strength, params.occlusion_radius,
                                          params.occlusion_lines, wraps);
  if (params.curvature)
    maps["curvature"] =
        curvature(height, params.strength, params.curvature_radius, params.curvature_scale, wraps);
  return maps;
}

Cost estimate_maps(const MapParams& params, Size size) {
  const double pixels = 1.0 * size.width * size.height;
  const double lines = params.occlusion_lines;
  return {4 * pixels * (4 * params.normal + 3 * params.occlusion + 4 * params.curvature),
          {.shared = pixels * (1e-8 * params.normal + 1.2e-8 * lines * params.occlusion +
                               3e-8 * params.curvature)}};
}

Cost estimate_maps(const SurfaceParams& params, Size size, Tile wraps) {
  Cost cost = estimate_maps(static_cast<const MapParams&>(params), size);
  if (!params.guess) return cost;
  // Planes with what is beyond edges that meet, half a shorter side each way.
  const double beyond = 1.05 * std::min(size.width, size.height);
  const double pixels = 1.0 * size.width * size.height,
               padded = (size.width + (tiles_x(wraps) ? beyond : 0)) *
                        (size.height + (tiles_y(wraps) ? beyond : 0));
  cost.bytes = std::max(cost.bytes, 8 * pixels + 20 * padded);
  cost.work.serial += 1e-7 * padded;
  return cost;
}

Image one_channel(const Image& map, std::string_view called) {
  constexpr float tolerance = 3.0f / 255;
  if (map.channels == 1) return map;
  for (std::size_t i = 0; i < map.pixels.size();) {
    const float first = map.pixels[i++];
    for (int c = 1; c < map.channels; ++c)
      if (std::abs(map.pixels[i++] - first) > tolerance)
        throw Error("a {} map has {} channels that differ, allowed is 1", called, map.channels);
  }
  return extract_channels(map, 0, 1);
}

}  // namespace gramloom
