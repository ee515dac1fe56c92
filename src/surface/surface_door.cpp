#include "core/modules.h"
#include "surface/mesh_file.h"
#include "surface/surface_module.h"

namespace gramloom {

std::unique_ptr<RayScene> make_ray_scene(const Mesh& mesh) {
  return open_module<SurfaceModule>().ray_scene(mesh);
}

std::unique_ptr<TextureLookup> make_lookup(const Image& picture, Lookup lookup, Outside outside) {
  return open_module<SurfaceModule>().lookup(picture, lookup, outside);
}

Mesh read_mesh(const std::filesystem::path& path) {
  return open_module<SurfaceModule>().read_mesh(path);
}

}  // namespace gramloom
