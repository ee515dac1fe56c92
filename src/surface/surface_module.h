#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "surface/rays.h"
#include "surface/texture_lookup.h"

namespace gramloom {

/// What of surface/ needs Embree, OpenImageIO's TextureSystem or tinyobjloader (core/modules.h):
/// the functions make_ray_scene, make_lookup and read_mesh.
struct SurfaceModule {
  static constexpr std::string_view name = "surface";
  std::unique_ptr<RayScene> (*ray_scene)(const Mesh& mesh);
  std::unique_ptr<TextureLookup> (*lookup)(const Image& picture, Lookup lookup, Outside outside);
  Mesh (*read_mesh)(const std::filesystem::path& path);
};

namespace surface_module {
std::unique_ptr<RayScene> ray_scene(const Mesh& mesh);
std::unique_ptr<TextureLookup> lookup(const Image& picture, Lookup lookup, Outside outside);
Mesh read_mesh(const std::filesystem::path& path);
}  // namespace surface_module

}  // namespace gramloom
