#pragma once

#include <optional>
#include <string_view>

#include "surface/camera.h"
#include "surface/preview.h"
#include "surface/rays.h"

namespace gramloom {

/// How points of a shape get their texture coordinates.
struct MappingOf {
  Mapping mapping = Mapping::own;
  MappingFrame frame;
  LinearMap linear;
  float half_angle = 0;
  float around = 1;  // how often a square picture goes around when it goes up the shape once

  /// Of a point of a triangle of the mesh, by its place there.
  Coordinates at(const Mesh& mesh, const Hit& hit, const Vec3& place) const;
};

/// Throws Error when the mesh's own coordinates are asked for and it has none.
MappingOf make_mapping(const PreviewParams& params, const Mesh& mesh);

/// How often a picture of this size is repeated along u and v.
Vec2 repeats(const PreviewParams& params, const MappingOf& mapping, Size size);

/// The camera that the params ask for. A plane is larger than the other shapes and is seen from
/// further away, and, unless told, from further above.
Camera preview_camera(const PreviewParams& params);

/// The shape of this name, or none for a file. Throws ConfigError for a name that no shape has.
std::optional<Shape> named_shape(const FileOrName& shape);

/// Three numbers of the params. Throws ConfigError for another count.
Vec3 vector_of(std::string_view name, const std::vector<double>& list);

}  // namespace gramloom
