#pragma once

#include <memory>
#include <string>
#include <vector>

#include "surface/camera.h"
#include "surface/environment.h"
#include "surface/preview_mapping.h"
#include "surface/preview_material.h"
#include "surface/rays.h"

namespace gramloom {

/// All that a preview is rendered from.
struct PreviewScene {
  const PreviewParams& params;
  Mesh mesh;                    // before displacement
  std::vector<Vec3> positions;  // of its vertices after it; empty: the same
  std::unique_ptr<RayScene> rays;
  MappingOf mapping;
  std::vector<PreviewMaterial> covers;  // what stochastic tiling made of the materials, if it did
  std::vector<MaterialLookup> materials;
  Camera camera;
  float radius = 1;  // of the ball around the origin that holds the displaced mesh
  float ground = 0;  // its height

  Vec3 light;              // unit vector towards the lamp
  Vec3 light_colour;       // times its strength
  float light_spread = 0;  // tangent of half its diameter
  std::unique_ptr<TextureLookup> environment;
  Irradiance irradiance;
  float environment_strength = 1;
  Vec3 background;

  std::vector<std::string> notes;  // what it does not show as it is

  const Vec3& position(std::uint32_t vertex) const {
    return positions.empty() ? mesh.positions[vertex] : positions[vertex];
  }
};

/// What is to be seen, made ready. Throws as render_preview() does.
PreviewScene make_scene(const PreviewParams& params, std::span<const PreviewMaterial> materials,
                        const Image& environment);

/// The light of pixels [left, right) × [top, bottom) of the picture, with alpha.
struct PixelBlock {
  int left, top, right, bottom;
};
void render_block(const PreviewScene& scene, const PixelBlock& block, Image& picture);

}  // namespace gramloom
