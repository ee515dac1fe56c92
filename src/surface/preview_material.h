#pragma once

#include <memory>
#include <span>
#include <vector>

#include "surface/coordinates.h"
#include "surface/preview.h"

namespace gramloom {

/// A point of a surface to be shaded.
struct SurfacePoint {
  Vec3 position;    // where the ray met it
  Vec3 place;       // the same before displacement
  Vec3 normal;      // unit, smooth, on the side that is seen; before bumps
  Coordinates at;   // before repetition; not of solids
  Vec3 across, up;  // how far the point moves over a sample's width and height
  Material material;
  Vec3 bumped;          // the unit normal that is shaded
  float occlusion = 1;  // of light from all around, by a map
};

/// A material made ready: its pictures in one, so that a point needs one lookup.
class MaterialLookup {
 public:
  MaterialLookup(const PreviewParams& params, const PreviewMaterial& material, Vec2 repeat,
                 const MappingFrame& frame);

  /// Fills material, bumped and occlusion of the points.
  void look_up(std::span<SurfacePoint*> points) const;
  /// The heights at texture coordinates, for displacement; `width`: of an edge, in them.
  std::vector<float> heights(std::span<const Coordinates> places, float edge) const;
  bool has_height() const { return !material_.maps.empty() && material_.maps.contains("height"); }

 private:
  struct Channels {
    int colour = -1, coverage = -1, slopes = -1, normal = -1, roughness = -1, metalness = -1,
        occlusion = -1;
  };
  Image packed();
  Footprint footprint(const SurfacePoint& point) const;
  void apply(const float* values, SurfacePoint& point) const;

  const PreviewParams& params_;
  const PreviewMaterial& material_;
  Vec2 repeat_;
  MappingFrame frame_;            // of a solid
  Vec3 colour_, outside_colour_;  // the params', linear
  Channels channels_;
  int count_ = 0;
  std::unique_ptr<TextureLookup> lookup_, height_;
};

/// Of a material's pictures; one pixel where it has none.
Size size_of(const PreviewMaterial& material);

/// Throws Error for maps of different sizes or channels that they cannot have.
void check_material(const PreviewMaterial& material);

/// A colour of the config, as pictures store it, in linear values.
Vec3 linear_colour(const std::vector<double>& colour);

}  // namespace gramloom
