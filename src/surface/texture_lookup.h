#pragma once

#include <memory>
#include <span>

#include "core/fields.h"
#include "core/image.h"
#include "surface/vec3.h"
#include "surface/volume.h"

namespace gramloom {

/// How a picture is looked up between its pixels.
///   nearest   the pixel's own value
///   bilinear  between the centres of four pixels
///   bicubic   a cubic B-spline of sixteen: smooth, a little soft
///   filtered  bilinear where the picture is enlarged, and where it is reduced the mean of what a
///             sample covers, by mip maps along the longer way (anisotropic)
enum class Lookup { nearest, bilinear, bicubic, filtered };
template <>
inline constexpr auto enum_names<Lookup> = std::to_array<std::string_view>({"nearest", "bilinear",
                                                                            "bicubic", "filtered"});

/// A place of a picture, which covers [0, 1]² with v up, and how far u and v change over the width
/// and the height of what is to be looked up.
struct Footprint {
  Vec2 at;
  Vec2 width, height;
};

/// A direction, and how far it changes over what is to be looked up.
struct Cone {
  Vec3 direction;
  float width = 0;
};

/// A picture ready to be looked up, from any thread, by OpenImageIO's TextureSystem.
class TextureLookup {
 public:
  virtual ~TextureLookup() = default;
  /// All channels at each place, one place after the other.
  virtual void at(std::span<const Footprint> places, std::span<float> values) const = 0;
  /// The first three channels of a latitude–longitude picture (surface/environment.h), filtered.
  virtual void along(std::span<const Cone> cones, std::span<Vec3> values) const = 0;
};

/// From the module. With Outside::colour every channel is 0 beyond the edges.
std::unique_ptr<TextureLookup> make_lookup(const Image& picture, Lookup lookup, Outside outside);

}  // namespace gramloom
