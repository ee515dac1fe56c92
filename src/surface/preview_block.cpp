#include "surface/preview_samples.h"
#include "surface/preview_scene.h"

namespace gramloom {

namespace {

constexpr float skin = 2e-4f;  // how far from a surface its shadow rays begin

// Whether a ray can meet the ball around the shape at all.
bool near_shape(const PreviewScene& scene, const Vec3& origin, const Vec3& direction) {
  const float along = -dot(origin, direction);
  const float distance2 = dot(origin, origin) - along * along;
  const float r2 = scene.radius * scene.radius * 1.001f;
  return distance2 <= r2 && (along > 0 || dot(origin, origin) <= r2);
}

struct Sample {
  std::size_t pixel;
  Ray ray;
  Chance chance;
};

// A sample that met the shape, or the ground.
struct ShapePoint {
  std::size_t sample;
  SurfacePoint surface;
  std::size_t material = 0;
  Vec3 face;  // the triangle's own normal, on the side that is seen
};
struct GroundPoint {
  std::size_t sample;
  Vec3 position;
};

class BlockRenderer {
 public:
  BlockRenderer(const PreviewScene& scene, const PixelBlock& block, Image& picture)
      : scene_(scene), block_(block), picture_(picture) {}

  void render() {
    shoot();
    look_up();
    shade_shape();
    shade_ground();
    const auto count = static_cast<float>(scene_.params.samples * scene_.params.samples);
    for (int y = block_.top; y < block_.bottom; ++y)
      for (int x = block_.left; x < block_.right; ++x)
        for (int c = 0; c < 4; ++c) picture_.at(x, y)[c] /= count;
  }

 private:
  // The rays of the block, and what they meet.
  void shoot() {
    const auto per_pixel = static_cast<std::size_t>(scene_.params.samples * scene_.params.samples);
    std::vector<Chance> chances(per_pixel);
    std::vector<Ray> rays;
    for (int y = block_.top; y < block_.bottom; ++y)
      for (int x = block_.left; x < block_.right; ++x) {
        draw(x, y, chances);
        for (const Chance& chance : chances) {
          const Ray ray = scene_.camera.ray(static_cast<float>(x) + chance.pixel.u,
                                            static_cast<float>(y) + chance.pixel.v);
          samples_.push_back({picture_.index(x, y), ray, chance});
          rays.push_back(ray);
        }
      }
    std::vector<Hit> hits(rays.size());
    scene_.rays->nearest(rays, hits);
    for (std::size_t i = 0; i < hits.size(); ++i)
      if (hits[i].triangle != Hit::none)
        shape_.push_back(shape_point(i, hits[i]));
      else
        miss(i);
  }

  ShapePoint shape_point(std::size_t index, const Hit& hit) const {
    const Ray& ray = samples_[index].ray;
    const auto& t = scene_.mesh.triangles[hit.triangle];
    const float b1 = 1 - hit.b2 - hit.b3;
    const auto between = [&](const std::vector<Vec3>& v) {
      return v[t[0]] * b1 + v[t[1]] * hit.b2 + v[t[2]] * hit.b3;
    };
    ShapePoint point{index, {}, 0, {}};
    SurfacePoint& s = point.surface;
    s.position = ray.origin + ray.direction * hit.distance;
    s.place = between(scene_.mesh.positions);
    const Vec3& corner = scene_.position(t[0]);
    point.face = normalised(cross(scene_.position(t[1]) - corner, scene_.position(t[2]) - corner));
    s.normal = normalised(between(scene_.mesh.normals));
    if (dot(point.face, ray.direction) > 0) point.face = -point.face;
    if (dot(s.normal, point.face) < 0) s.normal = -s.normal;
    s.at = scene_.mapping.at(scene_.mesh, hit, s.place);
    // A sample's own part of the pixel, as it lies on the surface.
    const float width =
        scene_.camera.pixel_width(hit.distance) / static_cast<float>(scene_.params.samples);
    const Vec3 right = normalised(scene_.camera.right), down = normalised(scene_.camera.down);
    const float facing = std::min(dot(s.normal, ray.direction), -0.08f);
    s.across = (right - ray.direction * (dot(right, s.normal) / facing)) * width;
    s.up = (down - ray.direction * (dot(down, s.normal) / facing)) * width;
    if (scene_.materials.size() > 1) point.material = in_second(s) ? 1 : 0;
    return point;
  }

  // Whether the pattern gives the point to the second material.
  bool in_second(const SurfacePoint& s) const {
    const auto k = static_cast<float>(scene_.params.pattern_repeat);
    const bool stripes = scene_.params.pattern == Pattern::stripes;
    if (scene_.params.mapping == Mapping::solid) {
      const auto cell = [&](float v) { return static_cast<int>(std::floor(v * k + 1e-4f)); };
      const int sum =
          stripes ? cell(s.place.y) : cell(s.place.x) + cell(s.place.y) + cell(s.place.z);
      return (sum & 1) != 0;
    }
    const float around = std::max(1.0f, std::round(k * scene_.mapping.around)) * 2;
    const int u = static_cast<int>(std::floor(s.at.u * around));
    const int v = static_cast<int>(std::floor(s.at.v * k * 2));
    return ((stripes ? v : u + v) & 1) != 0;
  }

  void miss(std::size_t index) {
    const Ray& ray = samples_[index].ray;
    if (scene_.params.ground && ray.direction.y < 0 && ray.origin.y > scene_.ground) {
      const float distance = (scene_.ground - ray.origin.y) / ray.direction.y;
      const Vec3 position = ray.origin + ray.direction * distance;
      // Far away no shadow falls.
      if (length(position) < 30 * scene_.radius) {
        ground_.push_back({index, position});
        return;
      }
    }
    add(index, background(index), scene_.params.background == Background::transparent ? 0 : 1);
  }

  Vec3 background(std::size_t index) const {
    switch (scene_.params.background) {
      case Background::transparent:
        return {};
      case Background::environment: {
        const Cone cone{samples_[index].ray.direction, 1e-3f};
        Vec3 colour;
        scene_.environment->along({&cone, 1}, {&colour, 1});
        return colour * scene_.environment_strength;
      }
      case Background::studio:
        break;
    }
    // Lighter behind the shape than in the corners.
    const Vec3 middle = normalised(
        scene_.camera.corner + scene_.camera.right * (0.5f * static_cast<float>(picture_.width)) +
        scene_.camera.down * (0.42f * static_cast<float>(picture_.height)));
    const float off = 1 - dot(middle, samples_[index].ray.direction);
    return scene_.background * (1.06f - 6 * std::min(off, 0.06f));
  }

  void look_up() {
    for (std::size_t m = 0; m < scene_.materials.size(); ++m) {
      std::vector<SurfacePoint*> points;
      for (ShapePoint& point : shape_)
        if (point.material == m) points.push_back(&point.surface);
      if (!points.empty()) scene_.materials[m].look_up(points);
    }
    // A bumped normal may turn away from the viewer; the surface does not.
    for (ShapePoint& point : shape_) {
      const Vec3 view = -samples_[point.sample].ray.direction;
      const float facing = dot(point.surface.bumped, view);
      if (facing < 0.02f)
        point.surface.bumped = normalised(point.surface.bumped + view * (0.02f - facing));
    }
  }

  // 0 for each ray that the shape is in the way of, else 1; rays of no reach are not asked.
  std::vector<std::uint8_t> visible(std::span<const Ray> rays, bool alike) const {
    std::vector<std::uint8_t> seen(rays.size(), 1);
    std::vector<Ray> close;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (rays[i].reach > 0 && near_shape(scene_, rays[i].origin, rays[i].direction)) {
        close.push_back(rays[i]);
        index.push_back(i);
      }
    std::vector<std::uint8_t> blocked(close.size());
    scene_.rays->blocked(close, alike, blocked);
    for (std::size_t i = 0; i < close.size(); ++i) seen[index[i]] = blocked[i] ? 0 : 1;
    return seen;
  }

  void shade_shape() {
    const std::size_t count = shape_.size();
    std::vector<Ray> lamp(count), sky(count);
    for (std::size_t i = 0; i < count; ++i) {
      const SurfacePoint& s = shape_[i].surface;
      const Chance& chance = samples_[shape_[i].sample].chance;
      const Vec3 start = s.position + shape_[i].face * skin;
      lamp[i] = {start, towards_lamp(scene_.light, scene_.light_spread, chance.lamp)};
      // What faces away from the lamp is dark without asking.
      if (dot(s.bumped, lamp[i].direction) <= 0) lamp[i].reach = 0;
      sky[i] = {start, towards_sky(scene_.positions.empty() ? s.normal : s.bumped, chance.sky[0])};
    }
    const auto lit = visible(lamp, true);
    const auto open = visible(sky, false);
    const std::vector<Vec3> mirrored_light = mirrored_environment();
    for (std::size_t i = 0; i < count; ++i) {
      const SurfacePoint& s = shape_[i].surface;
      const Vec3 view = -samples_[shape_[i].sample].ray.direction;
      Vec3 light;
      if (lit[i] && lamp[i].reach > 0)
        light = scene_.light_colour * shade(s.material, s.bumped, lamp[i].direction, view);
      // Half of what is mirrored comes from where the sky ray may not have looked.
      const float sky_seen = open[i] ? s.occlusion : 0;
      const float mirror_seen = s.occlusion * (open[i] ? 1.0f : 0.35f);
      light += shade_environment(s.material, s.bumped, view,
                                 irradiance_at(scene_.irradiance, s.bumped) * sky_seen,
                                 mirrored_light[i] * mirror_seen) *
               scene_.environment_strength;
      add(shape_[i].sample, light, 1);
    }
  }

  // What the points of metal surfaces mirror. A rough one sees about what a cosine does.
  std::vector<Vec3> mirrored_environment() const {
    constexpr float smooth = 0.4f, rough = 0.6f;
    std::vector<Vec3> light(shape_.size());
    if (scene_.params.shading != Shading::metal) return light;
    std::vector<Cone> cones;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < shape_.size(); ++i) {
      const SurfacePoint& s = shape_[i].surface;
      const Vec3 direction = mirrored(-samples_[shape_[i].sample].ray.direction, s.bumped);
      const float r = s.material.roughness;
      if (r > smooth) light[i] = irradiance_at(scene_.irradiance, direction);
      if (r >= rough) continue;
      // The width of the lobe of GGX, about twice the square of the roughness.
      cones.push_back({direction, std::max(2 * r * r, 2e-3f)});
      index.push_back(i);
    }
    std::vector<Vec3> sharp(cones.size());
    scene_.environment->along(cones, sharp);
    for (std::size_t i = 0; i < index.size(); ++i) {
      const float r = shape_[index[i]].surface.material.roughness;
      const float share = std::clamp((rough - r) / (rough - smooth), 0.0f, 1.0f);
      light[index[i]] = mix(light[index[i]], sharp[i], share);
    }
    return light;
  }

  // The ground is seen by its shadow alone, so that it needs no end.
  void shade_ground() {
    const Vec3 up{0, 1, 0};
    // Nothing hides the grain of few samples on an even ground: each looks at the sky twice.
    constexpr std::size_t looks = std::tuple_size_v<decltype(Chance::sky)>;
    std::vector<Ray> lamp(ground_.size()), sky(ground_.size() * looks);
    for (std::size_t i = 0; i < ground_.size(); ++i) {
      const Chance& chance = samples_[ground_[i].sample].chance;
      const Vec3 start = ground_[i].position + up * skin;
      lamp[i] = {start, towards_lamp(scene_.light, scene_.light_spread, chance.lamp)};
      for (std::size_t k = 0; k < looks; ++k)
        sky[i * looks + k] = {start, towards_sky(up, chance.sky[k])};
    }
    const auto lit = visible(lamp, true);
    const auto seen = visible(sky, false);
    const Vec3 from_lamp = scene_.light_colour * std::max(dot(up, scene_.light), 0.0f);
    const Vec3 from_sky = irradiance_at(scene_.irradiance, up) * scene_.environment_strength;
    const float all = dot(from_lamp + from_sky, {1, 1, 1});
    for (std::size_t i = 0; i < ground_.size(); ++i) {
      float open = 0;
      for (std::size_t k = 0; k < looks; ++k) open += seen[i * looks + k];
      open /= static_cast<float>(looks);
      const float some = dot(from_lamp * lit[i] + from_sky * open, {1, 1, 1});
      const float share = all > 0 ? some / all : 1;
      const bool clear = scene_.params.background == Background::transparent;
      add(ground_[i].sample, background(ground_[i].sample) * share, clear ? 1 - share : 1);
    }
  }

  void add(std::size_t sample, const Vec3& light, float alpha) {
    float* p = picture_.pixels.data() + samples_[sample].pixel;
    p[0] += light.x;
    p[1] += light.y;
    p[2] += light.z;
    p[3] += alpha;
  }

  const PreviewScene& scene_;
  const PixelBlock& block_;
  Image& picture_;
  std::vector<Sample> samples_;
  std::vector<ShapePoint> shape_;
  std::vector<GroundPoint> ground_;
};

}  // namespace

void render_block(const PreviewScene& scene, const PixelBlock& block, Image& picture) {
  BlockRenderer(scene, block, picture).render();
}

}  // namespace gramloom
