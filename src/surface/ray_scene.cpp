#include <algorithm>

#include "core/error.h"
#include "surface/embree.h"
#include "surface/surface_module.h"

namespace gramloom::surface_module {

namespace {

RTCRay embree_ray(const Ray& ray) {
  RTCRay r{};
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tfar = ray.reach;
  r.mask = 0xFFFFFFFF;
  return r;
}

// Up to eight rays, side by side.
constexpr std::size_t pack = 8;
struct Pack {
  std::size_t count;
  alignas(32) int valid[pack];
};
Pack fill(RTCRay8& r, std::span<const Ray> rays) {
  Pack p{std::min(pack, rays.size()), {}};
  for (std::size_t i = 0; i < p.count; ++i) {
    p.valid[i] = -1;
    r.org_x[i] = rays[i].origin.x;
    r.org_y[i] = rays[i].origin.y;
    r.org_z[i] = rays[i].origin.z;
    r.dir_x[i] = rays[i].direction.x;
    r.dir_y[i] = rays[i].direction.y;
    r.dir_z[i] = rays[i].direction.z;
    r.tfar[i] = rays[i].reach;
    r.mask[i] = 0xFFFFFFFF;
  }
  return p;
}

class EmbreeScene : public RayScene {
 public:
  // One thread builds the tree: it is the same, and so is which of two triangles that meet is hit,
  // for any number of threads.
  explicit EmbreeScene(const Mesh& mesh) : device_(rtcNewDevice("threads=1")) {
    if (!device_) throw Error("Embree does not start (error {})", int{rtcGetDeviceError(nullptr)});
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree reads 16 bytes a vertex: its own copy has them.
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.positions.size()));
    auto* triangles = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (positions && triangles) {
      for (const Vec3& p : mesh.positions) {
        *positions++ = p.x;
        *positions++ = p.y;
        *positions++ = p.z;
      }
      for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) *triangles++ = corner;
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE) {
      release();
      throw Error("Embree cannot take a mesh of {} triangles (error {})", mesh.triangles.size(),
                  int{error});
    }
  }
  ~EmbreeScene() override { release(); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void nearest(std::span<const Ray> rays, std::span<Hit> hits) const override {
    for (std::size_t first = 0; first < rays.size(); first += pack) {
      RTCRayHit8 query{};
      std::fill_n(query.hit.geomID, pack, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(query.hit.instID[0], pack, RTC_INVALID_GEOMETRY_ID);
      const Pack p = fill(query.ray, rays.subspan(first));
      intersect(scene_, p.valid, query);
      for (std::size_t i = 0; i < p.count; ++i) {
        const bool met = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        hits[first + i] =
            met ? Hit{query.hit.primID[i], query.ray.tfar[i], query.hit.u[i], query.hit.v[i]}
                : Hit{};
      }
    }
  }

  void blocked(std::span<const Ray> rays, bool alike,
               std::span<std::uint8_t> answers) const override {
    if (!alike) {
      for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCRay query = embree_ray(rays[i]);
        occluded(scene_, query);
        answers[i] = query.tfar < 0;
      }
      return;
    }
    for (std::size_t first = 0; first < rays.size(); first += pack) {
      RTCRay8 query{};
      const Pack p = fill(query, rays.subspan(first));
      occluded(scene_, p.valid, query);
      for (std::size_t i = 0; i < p.count; ++i) answers[first + i] = query.tfar[i] < 0;
    }
  }

 private:
  void release() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<RayScene> ray_scene(const Mesh& mesh) {
  return std::make_unique<EmbreeScene>(mesh);
}

}  // namespace gramloom::surface_module
