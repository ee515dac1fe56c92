#include "surface/environment.h"

#include "core/error.h"
#include "core/neighbour.h"
#include "core/threads.h"

namespace gramloom {

namespace {

EnvironmentKind kind_of(const Image& p) {
  if (p.width == 2 * p.height) return EnvironmentKind::latlong;
  if (p.width == p.height) return EnvironmentKind::mirror_ball;
  if (p.width * 3 == p.height * 4 || p.width * 4 == p.height * 3 || p.width == 6 * p.height)
    return EnvironmentKind::sky_box;
  throw Error(
      "an environment of {}×{} pixels: allowed are twice as wide as high (latlong), square "
      "(mirror_ball), 4:3, 3:4 and 6:1 (sky_box)",
      p.width, p.height);
}

void check_proportions(const Image& p, EnvironmentKind kind) {
  if (kind == EnvironmentKind::latlong && p.width != 2 * p.height)
    throw Error("an environment of {}×{} pixels: a latlong picture is twice as wide as high",
                p.width, p.height);
  if (kind == EnvironmentKind::mirror_ball && p.width != p.height)
    throw Error("an environment of {}×{} pixels: a mirror_ball picture is square", p.width,
                p.height);
  if (kind == EnvironmentKind::sky_box && kind_of(p) != EnvironmentKind::sky_box)
    throw Error("an environment of {}×{} pixels: a sky_box is 4:3 or 3:4 (a cross) or 6:1", p.width,
                p.height);
}

Vec3 pixel(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return image.channels < 3 ? Vec3{p[0], p[0], p[0]} : Vec3{p[0], p[1], p[2]};
}

// The part of a picture with this corner and side, at (u, v).
Vec3 bilinear_in(const Image& picture, int left, int top, Size size, const Vec2& at) {
  const float x = at.u * static_cast<float>(size.width) - 0.5f;
  const float y = (1 - at.v) * static_cast<float>(size.height) - 0.5f;
  const float fx = std::floor(x), fy = std::floor(y);
  const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
  const auto at_pixel = [&](int i, int j) {
    return pixel(picture, left + neighbour(i, size.width, false),
                 top + neighbour(j, size.height, false));
  };
  return mix(mix(at_pixel(x0, y0), at_pixel(x0 + 1, y0), x - fx),
             mix(at_pixel(x0, y0 + 1), at_pixel(x0 + 1, y0 + 1), x - fx), y - fy);
}

// Where the faces +x, −x, +y, −y, +z, −z lie in a strip and in the crosses, in faces. The lowest
// face of the upright cross is −z's opposite, turned by half.
constexpr int strip[6][2]{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
constexpr int wide_cross[6][2]{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {3, 1}, {1, 1}};
constexpr int tall_cross[6][2]{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 3}, {1, 1}};

// Of one face.
int sky_box_side(const Image& picture) {
  if (picture.width == 6 * picture.height) return picture.height;
  return picture.width / (picture.height > picture.width ? 3 : 4);
}

Vec3 in_sky_box(const Image& picture, const Vec3& direction) {
  const bool is_strip = picture.width == 6 * picture.height;
  const bool tall = picture.height > picture.width;
  const int side = sky_box_side(picture);
  BoxPoint point = sky_box_of(direction);
  if (tall && point.face == 4) point.at = {1 - point.at.u, 1 - point.at.v};
  const auto& places = is_strip ? strip : tall ? tall_cross : wide_cross;
  const int* place = places[point.face];
  return bilinear_in(picture, place[0] * side, place[1] * side, {side, side}, point.at);
}

template <class Light>
Image latlong_image(int height, Light&& light) {
  Image image(2 * height, height, 3);
  parallel_for(height, 8, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < image.width; ++x) {
        const Vec3 colour = light(direction_of_latlong(
            {(static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
             1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height)}));
        float* to = image.at(x, y);
        to[0] = colour.x;
        to[1] = colour.y;
        to[2] = colour.z;
      }
  });
  return image;
}

// The nine real spherical harmonics of a unit direction.
std::array<float, 9> harmonics(const Vec3& d) {
  return {0.282095f,
          0.488603f * d.y,
          0.488603f * d.z,
          0.488603f * d.x,
          1.092548f * d.x * d.y,
          1.092548f * d.y * d.z,
          0.315392f * (3 * d.z * d.z - 1),
          1.092548f * d.x * d.z,
          0.546274f * (d.x * d.x - d.y * d.y)};
}

}  // namespace

Vec2 latlong_of(const Vec3& d) {
  return {0.5f + std::atan2(d.x, -d.z) / (2 * pi),
          0.5f + std::asin(std::clamp(d.y, -1.0f, 1.0f)) / pi};
}

Vec3 direction_of_latlong(const Vec2& at) {
  const float longitude = 2 * pi * (at.u - 0.5f), latitude = pi * (at.v - 0.5f);
  const float c = std::cos(latitude);
  return {c * std::sin(longitude), std::sin(latitude), -c * std::cos(longitude)};
}

Vec2 mirror_ball_of_normal(const Vec3& n) { return {0.5f * (n.x + 1), 0.5f * (n.y + 1)}; }

Vec2 mirror_ball_of(const Vec3& d) {
  const Vec3 half{d.x, d.y, d.z + 1};
  if (length(half) < 1e-6f) return {0.5f, 0};
  return mirror_ball_of_normal(normalised(half));
}

BoxPoint sky_box_of(const Vec3& d) {
  const float ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  const auto on = [](int face, float right, float up, float size) {
    return BoxPoint{face, {0.5f + 0.5f * right / size, 0.5f + 0.5f * up / size}};
  };
  if (ay >= ax && ay >= az) return d.y >= 0 ? on(2, d.x, d.z, ay) : on(3, d.x, -d.z, ay);
  if (ax >= az) return d.x >= 0 ? on(0, d.z, d.y, ax) : on(1, -d.z, d.y, ax);
  return d.z >= 0 ? on(4, -d.x, d.y, az) : on(5, d.x, d.y, az);
}

Image sky_box_strip(std::span<const Image> faces) {
  if (faces.size() != 6) throw Error("a sky box has {} faces: allowed are 6", faces.size());
  const int side = faces.front().width;
  Image strip(6 * side, side, 3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Image& face = faces[i];
    if (face.size() != Size{side, side})
      throw Error(
          "face {} of the sky box has {}×{} pixels and the first {}×{}: they must be square "
          "and of one size",
          i + 1, face.width, face.height, side, faces.front().height);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const Vec3 colour = pixel(face, x, y);
        float* to = strip.at(static_cast<int>(i) * side + x, y);
        to[0] = colour.x;
        to[1] = colour.y;
        to[2] = colour.z;
      }
  }
  return strip;
}

Image latlong_picture(const Image& picture, EnvironmentKind kind) {
  if (kind == EnvironmentKind::automatic) kind = kind_of(picture);
  check_proportions(picture, kind);
  // As fine at the horizon as the picture there: a face of a sky box covers a quarter of it.
  const int finest = kind == EnvironmentKind::sky_box ? 2 * sky_box_side(picture) : picture.height;
  const int height = std::clamp(finest, 64, 2048);
  switch (kind) {
    case EnvironmentKind::mirror_ball:
      return latlong_image(height,
                           [&](const Vec3& d) { return bilinear(picture, mirror_ball_of(d)); });
    case EnvironmentKind::sky_box:
      return latlong_image(height, [&](const Vec3& d) { return in_sky_box(picture, d); });
    default:
      return picture.channels == 3 ? picture : latlong_image(picture.height, [&](const Vec3& d) {
        return bilinear(picture, latlong_of(d));
      });
  }
}

Image studio(const Vec3& light, float floor) {
  const auto smooth = [](float from, float to, float v) {
    const float t = std::clamp((v - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
  };
  // Across from the lamp.
  const Vec3 side = normalised({-light.x, 0, 0.4f * light.z});
  return latlong_image(128, [&](const Vec3& d) {
    const float up = std::clamp(d.y, 0.0f, 1.0f), below = std::clamp(-d.y, 0.0f, 1.0f);
    const Vec3 sky = mix({0.60f, 0.64f, 0.70f}, {1.0f, 1.02f, 1.06f}, std::sqrt(up));
    // Under the shape the floor is in its shadow.
    const Vec3 ground = Vec3{0.93f, 0.92f, 0.90f} * (floor * (1 - 0.6f * below));
    const float box = std::exp(-12 * (1 - dot(d, light)));
    const float along = dot(normalised({d.x, 0, d.z}), side);
    const float strip =
        std::exp(-45 * (1 - along)) * smooth(0, 0.15f, d.y) * (1 - smooth(0.6f, 0.85f, d.y));
    return mix(ground, sky, smooth(-0.06f, 0.06f, d.y)) + Vec3{1.7f, 1.65f, 1.55f} * box +
           Vec3{0.9f, 0.95f, 1.0f} * strip;
  });
}

Irradiance irradiance_of(const Image& latlong) {
  std::array<std::array<double, 3>, 9> sums{};
  double solid_angle = 0;
  for (int y = 0; y < latlong.height; ++y) {
    const float v = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(latlong.height);
    const double weight = std::cos(static_cast<double>(pi * (v - 0.5f)));
    for (int x = 0; x < latlong.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(latlong.width);
      const auto h = harmonics(direction_of_latlong({u, v}));
      const Vec3 light = pixel(latlong, x, y);
      for (std::size_t i = 0; i < 9; ++i) {
        const double w = weight * static_cast<double>(h[i]);
        sums[i][0] += w * static_cast<double>(light.x);
        sums[i][1] += w * static_cast<double>(light.y);
        sums[i][2] += w * static_cast<double>(light.z);
      }
      solid_angle += weight;
    }
  }
  // The cosine's own harmonics, over π (equation 8): the mean, not the sum, of the light.
  constexpr double cosine[3]{1, 2.0 / 3, 0.25};
  Irradiance result;
  for (std::size_t i = 0; i < 9; ++i) {
    const double scale = 4 * pi / solid_angle * cosine[i == 0 ? 0 : i < 4 ? 1 : 2];
    result.coefficients[i] = {static_cast<float>(sums[i][0] * scale),
                              static_cast<float>(sums[i][1] * scale),
                              static_cast<float>(sums[i][2] * scale)};
  }
  return result;
}

Vec3 irradiance_at(const Irradiance& irradiance, const Vec3& normal) {
  const auto h = harmonics(normal);
  Vec3 sum;
  for (std::size_t i = 0; i < 9; ++i) sum += irradiance.coefficients[i] * h[i];
  return {std::max(sum.x, 0.0f), std::max(sum.y, 0.0f), std::max(sum.z, 0.0f)};
}

Vec3 bilinear(const Image& picture, const Vec2& at) {
  return bilinear_in(picture, 0, 0, picture.size(), at);
}

}  // namespace gramloom
