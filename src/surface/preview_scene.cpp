#include "surface/preview_scene.h"

#include <algorithm>

#include "core/error.h"
#include "surface/displacement.h"
#include "surface/mesh_file.h"
#include "surface/stochastic_cover.h"

namespace gramloom {

namespace {

// Shorter ones would make more triangles of a shape than a mesh may have.
constexpr float shortest_edge = 0.0045f;

Mesh load_shape(const PreviewParams& params, float longest) {
  const FileOrName& shape = params.shape;
  if (const auto named = named_shape(shape)) return make_shape(*named, longest, params.bend);
  return read_mesh(shape);
}

Mesh with_normals(Mesh mesh, Normals normals) {
  if (normals == Normals::flat) return faceted(mesh);
  if (normals == Normals::area) mesh.normals = smooth_normals(mesh, NormalWeights::area);
  if (normals == Normals::angle) mesh.normals = smooth_normals(mesh, NormalWeights::angle);
  return mesh;
}

void check_solid(const PreviewParams& params, const PreviewMaterial& material) {
  const bool is_solid = material.solid || !material.volume.slices.empty();
  if (params.mapping == Mapping::solid && !is_solid)
    throw ConfigError(
        "mapping = \"solid\": needs a solid texture or a stack of slices, here is one picture");
  if (params.mapping != Mapping::solid && is_solid)
    throw ConfigError("mapping = \"{}\": a solid texture has no picture to map; choose \"solid\"",
                      to_word(params.mapping));
  if (!material.volume.slices.empty()) check_volume(material.volume);
}

// More pixels of a cover than so many for each of the picture are never seen.
constexpr double cover_pixels = 8;

void add_materials(PreviewScene& scene, std::span<const PreviewMaterial> materials) {
  const PreviewParams& p = scene.params;
  scene.covers.reserve(materials.size());
  scene.materials.reserve(materials.size());
  for (const PreviewMaterial& material : materials) {
    const Vec2 repeat = repeats(p, scene.mapping, size_of(material));
    if (!p.stochastic) {
      scene.materials.emplace_back(p, material, repeat, scene.mapping.frame);
      continue;
    }
    const double longest =
        cover_pixels * std::max(p.size.width, p.size.height) * std::max(1.0, p.zoom);
    const Random random = Random(1).stream(scene.covers.size());
    Cover cover = covered(material, repeat, p.stochastic_rotation,
                          static_cast<int>(std::min(longest, 65536.0)), random);
    if (cover.lost < 0.995)
      scene.notes.push_back(
          fmt::format("stochastic: at {:.0f} % of the resolution that would be seen, for want of "
                      "memory: fewer repeats keep more",
                      100 * cover.lost));
    scene.covers.push_back(std::move(cover.material));
    scene.materials.emplace_back(p, scene.covers.back(), Vec2{1, 1}, scene.mapping.frame);
  }
}

// Vertices moved by the materials' heights; where two share the shape, by the first's.
void displace(PreviewScene& scene, float edge) {
  const Mesh& mesh = scene.mesh;
  std::vector<Coordinates> places(mesh.positions.size());
  if (scene.params.mapping != Mapping::own) {
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] = scene.mapping.at(mesh, {}, mesh.positions[i]);
  } else {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      const Coordinates at = scene.mapping.at(mesh, {t, 0, 0, 0}, {});
      for (const std::uint32_t c : corners)
        places[c] = {mesh.coordinates[c].u, mesh.coordinates[c].v, at.du, at.dv};
    }
  }
  const auto heights = scene.materials.front().heights(places, edge);
  scene.positions = displaced(mesh, heights, static_cast<float>(scene.params.displacement));
}

float radius_of(const PreviewScene& scene) {
  float radius = 0;
  for (std::uint32_t i = 0; i < scene.mesh.positions.size(); ++i)
    radius = std::max(radius, length(scene.position(i)));
  return radius;
}

void place_camera(PreviewScene& scene) {
  const PreviewParams& p = scene.params;
  scene.radius = radius_of(scene);
  float lowest = scene.radius;
  for (std::uint32_t i = 0; i < scene.mesh.positions.size(); ++i)
    lowest = std::min(lowest, scene.position(i).y);
  scene.ground = lowest;
  scene.camera = preview_camera(p);
}

Image turned(const Image& latlong, double degrees) {
  const int by = static_cast<int>(std::lround(degrees / 360 * latlong.width));
  if (by == 0) return latlong;
  Image result = latlong;
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < result.channels; ++c)
        result.at(((x + by) % result.width + result.width) % result.width, y)[c] =
            latlong.at(x, y)[c];
  return result;
}

void light_up(PreviewScene& scene, const Image& environment) {
  const PreviewParams& p = scene.params;
  scene.light = direction_of(p.light[0], p.light[1]);
  scene.light_colour =
      vector_of("light_colour", p.light_colour) * static_cast<float>(p.light_strength);
  scene.light_spread = std::tan(static_cast<float>(p.light_size) * pi / 360);
  scene.environment_strength = static_cast<float>(p.environment_strength);
  const Image around =
      environment.empty()
          ? studio(scene.light, p.ground ? 0.6f : 0.45f)
          : turned(latlong_picture(environment, p.environment_kind), p.environment_turn);
  scene.irradiance = irradiance_of(around);
  scene.environment = make_lookup(around, Lookup::filtered, Outside::tile);
  scene.background = linear_colour(p.background_colour);
}

}  // namespace

PreviewScene make_scene(const PreviewParams& params, std::span<const PreviewMaterial> materials,
                        const Image& environment) {
  check_preview(params);
  if (materials.empty() || materials.size() > 2)
    throw Error("a preview shows 1 or 2 materials, here are {}", materials.size());
  for (const PreviewMaterial& material : materials) check_solid(params, material);
  PreviewScene scene{params, {}, {}, {}, {}, {}, {}, {}, 1, 0, {}, {}, 0, {}, {}, 1, {}, {}};
  const bool moves = params.displacement != 0;
  if (moves && !materials.front().maps.contains("height"))
    throw ConfigError("displacement = {}: the texture has no map 'height'", params.displacement);
  // The length of an edge that is `detail` pixels long in the picture, at the shape's middle.
  const Camera front = make_camera({0, 0, 1}, {}, 1, static_cast<float>(params.zoom), params.size);
  const float edge = std::max(
      static_cast<float>(params.detail) * front.pixel_width(length(front.origin)), shortest_edge);
  const float longest = moves ? edge : 1e3f;
  scene.mesh = with_normals(load_shape(params, longest), params.normals);
  if (moves && !named_shape(params.shape)) scene.mesh = subdivided(std::move(scene.mesh), edge);
  scene.mapping = make_mapping(params, scene.mesh);
  add_materials(scene, materials);
  if (moves) displace(scene, edge);
  Mesh traced{scene.positions.empty() ? scene.mesh.positions : scene.positions,
              {},
              {},
              scene.mesh.triangles};
  scene.rays = make_ray_scene(traced);
  place_camera(scene);
  light_up(scene, environment);
  return scene;
}

}  // namespace gramloom
