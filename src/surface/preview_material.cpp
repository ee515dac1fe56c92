#include "surface/preview_material.h"

#include "core/error.h"
#include "core/threads.h"
#include "surface/relief.h"

namespace gramloom {

namespace {

Vec3 map_colour(const float* p, int channels) {
  return channels < 3 ? Vec3{p[0], p[0], p[0]} : Vec3{p[0], p[1], p[2]};
}

// Copies `count` channels of `from` to those of `to` from `first` on.
void put(Image& to, int first, const Image& from, int count) {
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x)
      for (int c = 0; c < count; ++c) to.at(x, y)[first + c] = from.at(x, y)[c];
}

// ∂h/∂u and ∂h/∂v of a height map by central differences, where u and v cover it once.
void put_slopes(Image& to, int first, const Image& height, Tile wraps) {
  for_each_ground_row(height, 1, wraps, [&](int y, const GroundRows& rows) {
    for (int x = 0; x < to.width; ++x) {
      float* p = to.at(x, y) + first;
      p[0] = 0.5f * static_cast<float>(to.width) * (rows.here[x + 1] - rows.here[x - 1]);
      p[1] = 0.5f * static_cast<float>(to.height) * (rows.above[x] - rows.below[x]);
    }
  });
}

const Image* find(const PreviewMaterial& material, const std::string& name) {
  const auto at = material.maps.find(name);
  return at == material.maps.end() ? nullptr : &at->second;
}

}  // namespace

Size size_of(const PreviewMaterial& material) {
  if (!material.colour.empty()) return material.colour.size();
  if (!material.maps.empty()) return material.maps.begin()->second.size();
  return {1, 1};
}

Vec3 linear_colour(const std::vector<double>& c) {
  return {linear_from_srgb(static_cast<float>(c[0])), linear_from_srgb(static_cast<float>(c[1])),
          linear_from_srgb(static_cast<float>(c[2]))};
}

void check_material(const PreviewMaterial& material) {
  const Size size = size_of(material);
  for (const auto& [name, map] : material.maps) {
    if (std::find(preview_maps.begin(), preview_maps.end(), name) == preview_maps.end())
      throw Error("unknown map '{}': allowed are {}", name, fmt::join(preview_maps, ", "));
    if (map.size() != size)
      throw Error("the map '{}' has {}×{} pixels and the picture {}×{}: they must be alike", name,
                  map.width, map.height, size.width, size.height);
    const int needed = name == "normal" ? 3 : 1;
    if (map.channels < needed || (needed == 1 && map.channels > 1))
      throw Error("the map '{}' has {} channels, it needs {}", name, map.channels, needed);
  }
}

MaterialLookup::MaterialLookup(const PreviewParams& params, const PreviewMaterial& material,
                               Vec2 repeat, const MappingFrame& frame)
    : params_(params),
      material_(material),
      repeat_(repeat),
      frame_(frame),
      colour_(linear_colour(params.colour)),
      outside_colour_(linear_colour(params.outside_colour)) {
  check_material(material);
  if (Image picture = packed(); !picture.empty())
    lookup_ = make_lookup(picture, params.lookup, params.outside);
  if (const Image* height = find(material, "height"); height && params.displacement != 0)
    height_ = make_lookup(*height, params.lookup, params.outside);
}

// All that a point needs of the pictures, as the channels of one.
Image MaterialLookup::packed() {
  const bool solid = params_.mapping == Mapping::solid;
  const Image* height = find(material_, "height");
  const bool by_height = params_.displacement != 0 || (height && asks_for_relief(params_));
  const Image* normal = by_height ? nullptr : find(material_, "normal");
  const bool relief = !normal && height && (params_.displacement != 0 || params_.bump != 0);
  const auto take = [&](bool wanted, int channels) {
    if (!wanted) return -1;
    count_ += channels;
    return count_ - channels;
  };
  if (solid) return {};
  channels_.colour = take(!material_.colour.empty(), 3);
  channels_.coverage = take(params_.outside == Outside::colour, 1);
  channels_.slopes = take(relief, 2);
  channels_.normal = take(normal, 3);
  channels_.roughness = take(find(material_, "roughness"), 1);
  channels_.metalness = take(find(material_, "metalness"), 1);
  channels_.occlusion = take(find(material_, "occlusion"), 1);
  if (count_ == 0) return {};

  Image picture(size_of(material_), count_);
  if (channels_.colour >= 0)
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Vec3 c = map_colour(material_.colour.at(x, y), material_.colour.channels);
        float* p = picture.at(x, y) + channels_.colour;
        p[0] = c.x;
        p[1] = c.y;
        p[2] = c.z;
      }
  if (channels_.coverage >= 0) put(picture, channels_.coverage, Image(picture.size(), 1, 1), 1);
  if (relief)
    put_slopes(picture, channels_.slopes, *height,
               params_.outside == Outside::tile ? Tile::both : Tile::none);
  if (normal)
    put(picture, channels_.normal,
        colours_to_normals(*normal, params_.green.value_or(material_.green)), 3);
  if (channels_.roughness >= 0) put(picture, channels_.roughness, *find(material_, "roughness"), 1);
  if (channels_.metalness >= 0) put(picture, channels_.metalness, *find(material_, "metalness"), 1);
  if (channels_.occlusion >= 0) put(picture, channels_.occlusion, *find(material_, "occlusion"), 1);
  return picture;
}

Footprint MaterialLookup::footprint(const SurfacePoint& point) const {
  const Vec3 du = point.at.du * repeat_.u, dv = point.at.dv * repeat_.v;
  return {{point.at.u * repeat_.u, point.at.v * repeat_.v},
          {dot(du, point.across), dot(dv, point.across)},
          {dot(du, point.up), dot(dv, point.up)}};
}

// What the channels at a point say.
void MaterialLookup::apply(const float* values, SurfacePoint& point) const {
  Material& m = point.material;
  const float inside = channels_.coverage >= 0 ? values[channels_.coverage] : 1;
  const auto scalar = [&](int channel, float otherwise) {
    return channel < 0 ? otherwise
                       : std::clamp(values[channel] + otherwise * (1 - inside), 0.0f, 1.0f);
  };
  if (channels_.colour >= 0) {
    const float* c = values + channels_.colour;
    m.colour = m.colour * (Vec3{c[0], c[1], c[2]} + outside_colour_ * (1 - inside));
  }
  m.roughness = scalar(channels_.roughness, m.roughness);
  m.metalness = scalar(channels_.metalness, m.metalness);
  point.occlusion = scalar(channels_.occlusion, 1);
  const Vec3 du = point.at.du * repeat_.u, dv = point.at.dv * repeat_.v;
  if (channels_.slopes >= 0) {
    // The normal of a surface raised by the height: n − ∇h (Blinn 1978).
    const float high =
        static_cast<float>(params_.displacement != 0 ? params_.displacement : params_.bump);
    const float* h = values + channels_.slopes;
    const Vec3 slope = (du * h[0] + dv * h[1]) * high;
    point.bumped = normalised(point.normal - (slope - point.normal * dot(slope, point.normal)));
  } else if (channels_.normal >= 0) {
    // Along the surface: where u grows and v stays, and the other way round.
    Vec3 t = cross(dv, point.normal), b = cross(point.normal, du);
    if (dot(t, du) < 0) t = -t;
    if (dot(b, dv) < 0) b = -b;
    const float* n = values + channels_.normal;
    if (length(t) > 0 && length(b) > 0)
      point.bumped = normalised(normalised(t) * n[0] + normalised(b) * n[1] +
                                point.normal * (n[2] + 1 - inside));
  }
}

void MaterialLookup::look_up(std::span<SurfacePoint*> points) const {
  for (SurfacePoint* point : points) {
    point->material = {params_.shading,
                       colour_,
                       static_cast<float>(params_.roughness),
                       static_cast<float>(params_.metalness),
                       static_cast<float>(params_.specular),
                       static_cast<float>(params_.shininess)};
    point->bumped = point->normal;
    point->occlusion = 1;
  }
  if (params_.mapping == Mapping::solid) {
    std::vector<Vec3> places(points.size()), colours(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) places[i] = in_solid(frame_, points[i]->place);
    if (material_.solid) {
      const float width = points.empty() ? 0 : length(points.front()->across) / frame_.size;
      material_.solid(places, width, colours);
    } else {
      for (std::size_t i = 0; i < points.size(); ++i)
        colours[i] = trilinear(material_.volume, places[i], params_.outside, outside_colour_);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i]->material.colour = points[i]->material.colour * colours[i];
    return;
  }
  if (!lookup_) return;
  std::vector<Footprint> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) places[i] = footprint(*points[i]);
  const auto channels = static_cast<std::size_t>(count_);
  std::vector<float> values(points.size() * channels);
  lookup_->at(places, values);
  for (std::size_t i = 0; i < points.size(); ++i) apply(&values[i * channels], *points[i]);
}

std::vector<float> MaterialLookup::heights(std::span<const Coordinates> places, float edge) const {
  std::vector<float> values(places.size());
  if (!height_) return values;
  std::vector<Footprint> footprints(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Coordinates& at = places[i];
    footprints[i] = {{at.u * repeat_.u, at.v * repeat_.v},
                     {length(at.du) * repeat_.u * edge, 0},
                     {0, length(at.dv) * repeat_.v * edge}};
  }
  parallel_for(static_cast<std::int64_t>(places.size()), 4096, [&](std::int64_t a, std::int64_t b) {
    const auto first = static_cast<std::size_t>(a), count = static_cast<std::size_t>(b - a);
    height_->at(std::span(footprints).subspan(first, count),
                std::span(values).subspan(first, count));
  });
  return values;
}

}  // namespace gramloom
