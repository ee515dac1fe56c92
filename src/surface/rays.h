#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "surface/mesh.h"

namespace gramloom {

/// From `origin` along the unit vector `direction`, up to `reach`.
struct Ray {
  Vec3 origin, direction;
  float reach = std::numeric_limits<float>::infinity();
};

/// Where a ray meets a mesh first: the triangle and the weights of its second and third corner.
struct Hit {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::uint32_t triangle = none;
  float distance = 0;
  float b2 = 0, b3 = 0;
};

/// A mesh that rays can be shot at, from any thread.
class RayScene {
 public:
  virtual ~RayScene() = default;
  /// Of rays that run side by side, as those of a pixel do.
  virtual void nearest(std::span<const Ray> rays, std::span<Hit> hits) const = 0;
  /// 1 for each ray that meets anything, else 0. `alike`: rays that follow each other run side by
  /// side, which is quicker.
  virtual void blocked(std::span<const Ray> rays, bool alike,
                       std::span<std::uint8_t> answers) const = 0;
};

/// By Embree (Wald et al. 2014), from the module. The mesh must stay until the scene is gone.
std::unique_ptr<RayScene> make_ray_scene(const Mesh& mesh);

}  // namespace gramloom
