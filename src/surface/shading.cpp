#include "surface/shading.h"

namespace gramloom {

namespace {

constexpr float dielectric = 0.04f;  // what a non-metal mirrors of light straight from above

Vec3 mirrored_part(const Material& m) {
  return mix(Vec3{dielectric, dielectric, dielectric}, m.colour, m.metalness);
}

Vec3 schlick(const Vec3& f0, float cosine) {
  const float t = 1 - std::clamp(cosine, 0.0f, 1.0f);
  const float t5 = t * t * t * t * t;
  return f0 + (Vec3{1, 1, 1} - f0) * t5;
}

// How much light a surface mirrors of what comes from all around: `scale` of what it mirrors
// straight on, and `offset` (Karis 2014, "Physically based shading on mobile": a fit of the
// integral of the BRDF).
struct Mirroring {
  float scale, offset;
};
Mirroring mirroring(float roughness, float nv) {
  const float rx = 1 - roughness, ry = 0.0425f - 0.0275f * roughness;
  const float rz = 1.04f - 0.572f * roughness, rw = 0.022f * roughness - 0.04f;
  const float a = std::min(rx * rx, std::exp2(-9.28f * nv)) * rx + ry;
  return {-1.04f * a + rz, 1.04f * a + rw};
}

// Below this a highlight is smaller than any lamp.
constexpr float least_roughness = 0.03f;

Vec3 metal(const Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const float nl = dot(n, l), nv = std::max(dot(n, v), 1e-3f);
  const Vec3 half = normalised(l + v);
  const float nh = std::max(dot(n, half), 0.0f), vh = std::max(dot(v, half), 0.0f);
  const float roughness = std::max(m.roughness, least_roughness);
  const float a2 = roughness * roughness * roughness * roughness;
  const float d = nh * nh * (a2 - 1) + 1;
  const float distribution = a2 / (pi * d * d);
  const float masking =
      nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2);
  const Vec3 f = schlick(mirrored_part(m), vh);
  const Vec3 specular = f * (distribution * 0.5f / std::max(masking, 1e-6f));
  // What is mirrored on the way in or out is not left for the diffuse part.
  const Vec3 left = Vec3{1, 1, 1} - schlick(mirrored_part(m), std::min(nl, nv));
  const Vec3 diffuse = m.colour * left * ((1 - m.metalness) / pi);
  return (diffuse + specular) * (nl * pi);
}

}  // namespace

Vec3 shade(const Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const float nl = dot(n, l);
  if (nl <= 0) return {};
  if (m.shading == Shading::metal) return metal(m, n, l, v);
  Vec3 light = m.colour * nl;
  if (m.shading == Shading::phong) {
    const float highlight = std::max(dot(mirrored(l, n), v), 0.0f);
    const float s = m.specular * std::pow(highlight, m.shininess);
    light += Vec3{s, s, s};
  }
  return light;
}

Vec3 shade_environment(const Material& m, const Vec3& n, const Vec3& v, const Vec3& diffuse,
                       const Vec3& mirrored) {
  if (m.shading != Shading::metal) return m.colour * diffuse;
  const float nv = std::clamp(dot(n, v), 0.0f, 1.0f);
  const Mirroring part = mirroring(m.roughness, nv);
  const Vec3 f = mirrored_part(m) * part.scale + Vec3{part.offset, part.offset, part.offset};
  return m.colour * (Vec3{1, 1, 1} - f) * (1 - m.metalness) * diffuse + f * mirrored;
}

float linear_from_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float v) {
  return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

}  // namespace gramloom
