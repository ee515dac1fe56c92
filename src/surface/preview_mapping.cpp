#include "surface/preview_mapping.h"

#include <algorithm>
#include <tuple>

#include "core/error.h"

namespace gramloom {

namespace {

void check_pair(std::string_view name, const std::vector<double>& list) {
  if (list.size() != 2) throw ConfigError("{} has {} numbers: allowed are 2", name, list.size());
}

MappingFrame make_frame(const PreviewParams& p) {
  return mapping_frame(vector_of("mapping_origin", p.mapping_origin), vector_of("pole", p.pole),
                       vector_of("seam", p.seam), static_cast<float>(p.mapping_size));
}

// What places a mapping must have one to place.
void check_effects(const PreviewParams& p) {
  const PreviewParams usual;
  const bool framed = p.mapping != Mapping::own && p.mapping != Mapping::linear;
  const bool linear = p.mapping == Mapping::linear;
  for (const auto& [name, set, has_effect] :
       {std::tuple{"mapping_size", p.mapping_size != usual.mapping_size, framed},
        {"mapping_origin", p.mapping_origin != usual.mapping_origin, framed || linear},
        {"pole", p.pole != usual.pole, framed},
        {"seam", p.seam != usual.seam, framed},
        {"u_axis", p.u_axis != usual.u_axis, linear},
        {"v_axis", p.v_axis != usual.v_axis, linear},
        {"cone_angle", p.cone_angle != usual.cone_angle, p.mapping == Mapping::conical},
        {"bump", p.bump != usual.bump, p.mapping != Mapping::solid},
        {"repeat", !p.repeat.empty(), p.mapping != Mapping::solid}})
    if (set && !has_effect)
      throw ConfigError("{}: has no effect with mapping = \"{}\"", name, to_word(p.mapping));
}

}  // namespace

Vec3 vector_of(std::string_view name, const std::vector<double>& list) {
  if (list.size() != 3) throw ConfigError("{} has {} numbers: allowed are 3", name, list.size());
  return {static_cast<float>(list[0]), static_cast<float>(list[1]), static_cast<float>(list[2])};
}

std::optional<Shape> named_shape(const FileOrName& shape) {
  if (!shape.is_name()) return std::nullopt;
  const std::string word = shape.string();
  const auto& names = enum_names<Shape>;
  const auto at = std::find(names.begin(), names.end(), word);
  if (at != names.end()) return static_cast<Shape>(at - names.begin());
  const std::string guess = closest_word(word, {names.begin(), names.end()});
  throw ConfigError("unknown shape '{}'{}: allowed are {}, or a file (*.obj)", word,
                    guess.empty() ? "" : fmt::format(" (did you mean '{}'?)", guess),
                    fmt::join(names, ", "));
}

bool asks_for_relief(const PreviewParams& p) {
  return p.displacement != 0 || p.bump != PreviewParams{}.bump;
}

void check_preview(const PreviewParams& p) {
  check_fields(p);
  check_pair("light", p.light);
  if (!p.view.empty()) check_pair("view", p.view);
  for (const auto& [name, list] :
       {std::pair<std::string_view, const std::vector<double>&>{"colour", p.colour},
        {"outside_colour", p.outside_colour},
        {"light_colour", p.light_colour},
        {"background_colour", p.background_colour}})
    vector_of(name, list);
  if (p.repeat.size() > 2)
    throw ConfigError("repeat has {} numbers: allowed are 1 or 2", p.repeat.size());
  if (p.environment.size() > 1 && p.environment.size() != 6)
    throw ConfigError("environment has {} files: allowed are 1, or the 6 faces of a sky box",
                      p.environment.size());
  if (p.environment.size() == 6 && p.environment_kind != EnvironmentKind::automatic &&
      p.environment_kind != EnvironmentKind::sky_box)
    throw ConfigError("environment has 6 files, the faces of a sky box, and not a {}",
                      to_word(p.environment_kind));
  if (!named_shape(p.shape) && p.shape.extension() != ".obj" && p.shape.extension() != ".OBJ")
    throw ConfigError("shape '{}': allowed are {}, or a file (*.obj)", p.shape.string(),
                      fmt::join(enum_names<Shape>, ", "));
  if (p.bend != 0 && p.shape != "tube")
    throw ConfigError("bend = {}: only the tube bends, not '{}'", p.bend, p.shape.string());
  make_frame(p);
  linear_map({}, vector_of("u_axis", p.u_axis), vector_of("v_axis", p.v_axis));
  check_effects(p);
  if (p.mapping == Mapping::solid && p.displacement != 0)
    throw ConfigError("displacement = {}: a solid has no height map to displace it",
                      p.displacement);
  if (p.stochastic && p.mapping == Mapping::solid)
    throw ConfigError("stochastic: a solid is not repeated");
  if (p.stochastic && p.outside != Outside::tile)
    throw ConfigError("stochastic: what is outside the picture must be 'tile', not '{}'",
                      to_word(p.outside));
  if (!p.stochastic && p.stochastic_rotation != 0)
    throw ConfigError("stochastic_rotation = {}: has no effect without stochastic",
                      p.stochastic_rotation);
}

Camera preview_camera(const PreviewParams& p) {
  const bool plane = p.shape == "plane";
  std::vector<double> view = p.view;
  if (view.empty() && plane) view = {25, 38};
  if (view.empty() && p.shape == "tube") view = {-50, 12};  // its inside from the side
  if (view.empty()) view = {0, 14};
  return make_camera(direction_of(view[0], view[1]), preview_target, plane ? 1.15f : 1,
                     static_cast<float>(p.zoom), p.size);
}

MappingOf make_mapping(const PreviewParams& p, const Mesh& mesh) {
  MappingOf mapping;
  mapping.mapping = p.mapping;
  mapping.frame = make_frame(p);
  mapping.linear = linear_map(mapping.frame.origin, vector_of("u_axis", p.u_axis),
                              vector_of("v_axis", p.v_axis));
  mapping.half_angle = static_cast<float>(p.cone_angle) * pi / 180;
  const auto named = named_shape(p.shape);
  switch (p.mapping) {
    case Mapping::polar:
      mapping.around = 2;
      break;
    case Mapping::cylindrical:
    case Mapping::conical:
      mapping.around = pi;
      break;
    case Mapping::own:
      if (mesh.coordinates.empty())
        throw Error("{}: the mesh has no texture coordinates: choose another mapping than own",
                    p.shape.string());
      if (named) mapping.around = widths_around(*named);
      break;
    default:
      break;
  }
  return mapping;
}

Vec2 repeats(const PreviewParams& p, const MappingOf& mapping, Size size) {
  if (p.repeat.size() == 2)
    return {static_cast<float>(p.repeat[0]), static_cast<float>(p.repeat[1])};
  // Twice over a ball or a floor: once, features of most pictures are too large there.
  const bool own = p.mapping == Mapping::own;
  const bool twice =
      p.mapping == Mapping::polar || (own && (p.shape == "sphere" || p.shape == "plane"));
  const float up = p.repeat.empty() ? (twice ? 2.0f : 1.0f) : static_cast<float>(p.repeat[0]);
  const float square =
      up * mapping.around * static_cast<float>(size.height) / static_cast<float>(size.width);
  // Around a shape a whole number of them, or there would be a seam.
  return {mapping.around != 1 ? std::max(1.0f, std::round(square)) : square, up};
}

Coordinates MappingOf::at(const Mesh& mesh, const Hit& hit, const Vec3& place) const {
  switch (mapping) {
    case Mapping::own: {
      const auto& t = mesh.triangles[hit.triangle];
      return barycentric({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]},
                         {mesh.coordinates[t[0]], mesh.coordinates[t[1]], mesh.coordinates[t[2]]},
                         1 - hit.b2 - hit.b3, hit.b2);
    }
    case Mapping::linear:
      return gramloom::linear(linear, place);
    case Mapping::planar:
    case Mapping::solid:  // for patterns only
      return planar(frame, place);
    case Mapping::cylindrical:
      return cylindrical(frame, place);
    case Mapping::polar:
      return polar(frame, place);
    case Mapping::conical:
      return conical(frame, half_angle, place);
    case Mapping::cube:
      return cube(frame, place).at;
  }
  return {};
}

}  // namespace gramloom
