#include "jobs/solid_texture.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "core/error.h"
#include "jobs/method_reader.h"
#include "surface/maps.h"
#include "surface/shading.h"

namespace gramloom {

namespace {

Vec3 linear_of(const float* p) {
  return {linear_from_srgb(p[0]), linear_from_srgb(p[1]), linear_from_srgb(p[2])};
}

// Of a picture that shows all details of a small preview, and of a usual one (512 × 512) most.
int side_for(Size preview) {
  const auto longer = static_cast<unsigned>(std::max(preview.width, preview.height));
  return static_cast<int>(std::clamp(std::bit_ceil(2 * longer), 64u, 1024u));
}

}  // namespace

Solid solid_of(const ProceduralParams& params, Random random) {
  colours_at(params, {}, 0, random);  // refuses here what it would refuse later
  return [params, random](std::span<const Vec3> points, float width, std::span<Vec3> colours) {
    // In features, the texture's y downwards and its origin at the upper left front.
    const auto scale = static_cast<float>(params.scale);
    std::vector<std::array<float, 3>> places(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      places[i] = {points[i].x * scale, (1 - points[i].y) * scale, (1 - points[i].z) * scale};
    const Image made = colours_at(params, places, width * scale, random);
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = linear_of(&made.pixels[3 * i]);
  };
}

PreviewMaterial procedural_material(const std::string& name, const std::vector<std::string>& set,
                                    bool solid, Size preview) {
  const ProceduralParams params = std::get<ProceduralParams>(method_of("procedural", name, set));
  const Random random(1);
  PreviewMaterial material;
  if (solid) {
    const ProceduralParams usual;
    for (const auto& [key, value, otherwise] : {std::tuple{"depth", params.depth, usual.depth},
                                                {"tilt", params.tilt, usual.tilt},
                                                {"turn", params.turn, usual.turn}})
      if (value != otherwise)
        throw ConfigError(
            "--set {}: has no effect on a solid, which the shape cuts; --pole, --seam "
            "and --mapping-origin turn and move it",
            key);
    material.solid = solid_of(params, random);
    return material;
  }
  const int side = side_for(preview);
  Texture texture =
      synthesise(params, {.target = {{side, side}, Tile::both}, .random = random}, {});
  material.colour = linear_picture(texture.image);
  material.wraps = Tile::both;
  if (const auto height = texture.maps.find("height"); height != texture.maps.end())
    material.maps["height"] = std::move(height->second);
  return material;
}

}  // namespace gramloom
