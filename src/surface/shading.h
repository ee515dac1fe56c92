#pragma once

#include "core/fields.h"
#include "surface/vec3.h"

namespace gramloom {

/// How a surface answers light.
///   lambert  colour · n·l
///   phong    that, and specular · (r·v)^shininess (Phong 1975)
///   metal    metal–roughness, as glTF 2.0 has it (GGX: Walter et al. 2007)
enum class Shading { lambert, phong, metal };
template <>
inline constexpr auto enum_names<Shading> = std::to_array<std::string_view>({"lambert", "phong",
                                                                             "metal"});

/// A surface at a point: colours are linear, a white one is 1.
struct Material {
  Shading shading = Shading::metal;
  Vec3 colour{1, 1, 1};
  float roughness = 0.5f;  // 0 to 1, metal only
  float metalness = 0;     // 0 to 1, metal only
  float specular = 0.3f;   // phong only
  float shininess = 32;    // phong only
};

/// The light that leaves towards `view` of what comes from the direction `light`, all unit vectors,
/// from a light of strength 1: a white Lambert surface that faces it has the value 1. 0 where the
/// light is behind the surface. Of metal and Lambert surfaces no more light leaves than comes; the
/// former's is D G F / (4 n·l n·v) with GGX, Smith's correlated masking (Heitz 2014) and Schlick's
/// Fresnel, over what is left for diffuse light. What bounces from facet to facet is lost, as
/// usual: rough metals are darker than smooth ones.
Vec3 shade(const Material& material, const Vec3& normal, const Vec3& light, const Vec3& view);

/// The light that leaves towards `view` under an environment: `diffuse` is the mean of what falls
/// onto the surface weighted by the cosine, `mirrored` the mean around the mirrored view that a
/// surface this rough sees. Metal: the split sum of Karis 2013, "Real shading in Unreal Engine 4",
/// with his fit of the second part (2014). Phong and Lambert
/// surfaces mirror nothing here.
Vec3 shade_environment(const Material& material, const Vec3& normal, const Vec3& view,
                       const Vec3& diffuse, const Vec3& mirrored);

/// Between colours as pictures store them and linear ones (IEC 61966-2-1, sRGB).
float linear_from_srgb(float value);
float srgb_from_linear(float value);

}  // namespace gramloom
