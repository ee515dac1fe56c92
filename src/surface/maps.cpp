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

Cost estimate_maps(const SurfaceParams& params, Size size) {
  Cost cost = estimate_maps(static_cast<const MapParams&>(params), size);
  if (!params.guess) return cost;
  // Planes with what is beyond the edges, about as much again on each side.
  const double pixels = 1.0 * size.width * size.height;
  cost.bytes = std::max(cost.bytes, 70 * pixels);
  cost.work.serial += 2e-7 * pixels;
  return cost;
}

Image one_channel(const Image& height, float tolerance) {
  if (height.channels == 1) return height;
  for (std::size_t i = 0; i < height.pixels.size();) {
    const float first = height.pixels[i++];
    for (int c = 1; c < height.channels; ++c)
      if (std::abs(height.pixels[i++] - first) > tolerance)
        throw Error("a height map has {} channels that differ, allowed is 1", height.channels);
  }
  return extract_channels(height, 0, 1);
}

}  // namespace gramloom
