#include "procedural/texture.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/portable_math.h"
#include "procedural/solid.h"

namespace gramloom {

namespace {

/// Depth 0 is here: at an integer, every octave of noise would lie on a plane of its lattice.
constexpr float off_lattice = 0.381966f;

/// How many dimensions a texture has: a flat one 2, a solid one 3, noise as many as it is told.
int dimensions(const ProceduralTexture& texture) {
  return std::visit(
      [](const auto& t) {
        using T = std::decay_t<decltype(t)>;
        if constexpr (std::is_same_v<T, Noise>)
          return t.dimensions;
        else
          return T::solid ? 3 : 2;
      },
      texture);
}

void check(const ProceduralParams& params, Tile tile) {
  check_fields(params);
  std::visit([](const auto& texture) { check_fields(texture); }, params.texture);
  const bool tilted = params.tilt != 0 || params.turn != 0;
  if (dimensions(params.texture) < 3 && (tilted || params.depth != 0 || params.frames > 1))
    throw ConfigError("texture '{}' is flat: depth, tilt, turn and frames are for solids",
                      std::visit([](const auto& t) { return t.name; }, params.texture));
  if (tilted && (tile != Tile::none || params.loop))
    throw ConfigError("a plane with tilt or turn cannot tile or loop");
  if (params.loop && params.travel <= 0)
    throw ConfigError("a loop needs travel > 0: it comes back after that distance");
}

std::array<float, 3> light_from(double degrees) {
  constexpr double elevation = 0.85;  // radians above the surface
  const double angle = degrees * (portable::pi / 180);
  return {static_cast<float>(portable::cos(elevation) * portable::cos(angle)),
          static_cast<float>(-portable::cos(elevation) * portable::sin(angle)),
          static_cast<float>(portable::sin(elevation))};
}

/// The plane's axes for tilt around x after turn around y, about the picture's middle, and its
/// normal.
void place_plane(Canvas& canvas, const ProceduralParams& params, double along_normal) {
  const double radians = portable::pi / 180;
  const double ct = portable::cos(params.turn * radians), st = portable::sin(params.turn * radians);
  const double cs = portable::cos(params.tilt * radians), ss = portable::sin(params.tilt * radians);
  const std::array<double, 3> right{ct, 0, st}, down{-st * ss, cs, ct * ss},
      normal{-st * cs, -ss, ct * cs};
  const double half_width = static_cast<double>(canvas.width) / 2;
  const double half_height = static_cast<double>(canvas.height) / 2;
  const std::array<double, 3> middle{half_width, half_height, 0};
  for (std::size_t d = 0; d < 3; ++d) {
    canvas.right[d] = static_cast<float>(right[d]);
    canvas.down[d] = static_cast<float>(down[d]);
    canvas.origin[d] = static_cast<float>(middle[d] - right[d] * half_width -
                                          down[d] * half_height + normal[d] * along_normal);
  }
}

Canvas make_canvas(const ProceduralParams& params, const Target& target, Random random,
                   const Control& control) {
  Canvas canvas;
  canvas.size = target.size;
  canvas.tile = target.tile;
  canvas.samples = params.samples;
  const double shorter = std::min(target.size.width, target.size.height);
  const double step = params.scale / shorter;
  canvas.width = static_cast<float>(target.size.width * step);
  canvas.height = static_cast<float>(target.size.height * step);
  canvas.step_x = canvas.step_y = static_cast<float>(step);
  canvas.light = light_from(params.light);
  canvas.random = random;
  canvas.control = &control;
  if (params.loop) {
    canvas.loop_axis = dimensions(params.texture) == 4 ? 3 : 2;
    canvas.loop_length = static_cast<float>(params.travel);
  }
  return canvas;
}

}  // namespace

Texture synthesise(const ProceduralParams& params, const Request& request, const Control& control) {
  check(params, request.target.tile);
  check_request<ProceduralParams>(request);
  Canvas canvas = make_canvas(params, request.target, request.random, control);
  Texture result;
  for (int frame = 0; frame < params.frames; ++frame) {
    const double moved = params.travel * frame / params.frames;
    const bool fourth = dimensions(params.texture) == 4;
    place_plane(canvas, params, params.depth + (fourth ? 0 : moved));
    canvas.origin[3] = static_cast<float>(fourth ? moved : 0);
    for (std::size_t d = 2; d < 4; ++d) canvas.origin[d] += off_lattice;
    Texture picture = std::visit([&](const auto& t) { return paint(t, canvas); }, params.texture);
    if (params.frames > 1) result.maps[fmt::format("frame_{:04}", frame + 1)] = picture.image;
    if (frame > 0) continue;
    result.image = std::move(picture.image);
    result.maps.merge(picture.maps);
  }
  return result;
}

Image colours_at(const ProceduralParams& params, std::span<const std::array<float, 3>> points,
                 float width, Random random) {
  check(params, Tile::none);
  if (dimensions(params.texture) != 3)
    throw ConfigError("texture '{}' has {} dimensions: a shape can be carved from those of 3",
                      std::visit([](const auto& t) { return t.name; }, params.texture),
                      dimensions(params.texture));
  if (points.empty()) return {};
  const Control control;
  Canvas canvas =
      make_canvas(params, {{static_cast<int>(points.size()), 1}, Tile::none}, random, control);
  // The solid is that of a square picture.
  canvas.samples = 1;
  canvas.width = canvas.height = static_cast<float>(params.scale);
  canvas.step_x = canvas.step_y = std::max(width, 1e-4f);
  canvas.points = points;
  canvas.origin[2] = off_lattice;
  return std::visit([&](const auto& t) { return paint(t, canvas); }, params.texture).image;
}

Cost estimate(const ProceduralParams& params, const RequestSize& request) {
  check(params, request.tile);
  check_request<ProceduralParams>(request);
  // One pixel finds what the texture itself refuses, such as colours that are none.
  ProceduralParams one = params;
  one.frames = 1;
  synthesise(one, {{}, {{1, 1}, Tile::none}, Random(0)}, {});
  const double pixels = static_cast<double>(request.size.width) * request.size.height;
  const double samples = pixels * params.samples * params.samples * params.frames;
  const double images = 1 + params.frames;  // colours, and maps or what they are lit by
  return {pixels * 3 * sizeof(float) * images, {.shared = samples * 1.5e-7}};
}

}  // namespace gramloom
