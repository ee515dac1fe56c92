#include "surface/preview_samples.h"

#include "core/random.h"

namespace gramloom {

namespace {

float fraction(float v) { return v - std::floor(v); }

// i's binary digits behind the point in reverse: 0, 1/2, 1/4, 3/4, 1/8, … (van der Corput).
float reversed_digits(unsigned i) {
  float value = 0, digit = 0.5f;
  for (; i != 0; i >>= 1, digit *= 0.5f) value += (i & 1) != 0 ? digit : 0;
  return value;
}

// The i-th point of a sequence that fills the square evenly (Roberts 2018, "The unreasonable
// effectiveness of quasirandom sequences": multiples of the plastic number's inverses).
Vec2 even_point(float i) { return {fraction(i * 0.7548777f), fraction(i * 0.5698403f)}; }

// A point of a disc of radius 1 for one of a square, areas in proportion.
Vec2 on_disc(const Vec2& square) {
  const float r = std::sqrt(square.u), angle = 2 * pi * square.v;
  return {r * std::cos(angle), r * std::sin(angle)};
}

}  // namespace

void draw(int x, int y, std::span<Chance> samples) {
  const auto words =
      philox({static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0}, {0, 0});
  const auto shifted = [&](float i) {
    const Vec2 point = even_point(i);
    return Vec2{fraction(point.u + static_cast<float>(words[0] >> 8) * 0x1p-24f),
                fraction(point.v + static_cast<float>(words[1] >> 8) * 0x1p-24f)};
  };
  for (unsigned i = 0; i < samples.size(); ++i) {
    Chance& c = samples[i];
    const float half = 0.5f / static_cast<float>(samples.size());
    c.pixel = {2 * half * static_cast<float>(i) + half, reversed_digits(i) + half};
    const Vec2 lamp = shifted(static_cast<float>(i));
    c.lamp = {lamp.v, lamp.u};
    for (unsigned k = 0; k < c.sky.size(); ++k)
      c.sky[k] = shifted(static_cast<float>(i + k * static_cast<unsigned>(samples.size())));
  }
}

Vec3 towards_lamp(const Vec3& lamp, float spread, const Vec2& chance) {
  const Vec2 d = on_disc(chance) * spread;
  const Tangents t = tangents(lamp);
  return normalised(lamp + t.x * d.u + t.y * d.v);
}

Vec3 towards_sky(const Vec3& normal, const Vec2& chance) {
  const Vec2 d = on_disc(chance);
  const Tangents t = tangents(normal);
  return t.x * d.u + t.y * d.v + normal * std::sqrt(std::max(0.0f, 1 - d.u * d.u - d.v * d.v));
}

}  // namespace gramloom
