#pragma once

#include <array>
#include <span>

#include "surface/vec3.h"

namespace gramloom {

/// What a sample of a pixel needs of chance: places in [0, 1)² of the pixel, of the lamp and of the
/// sky.
struct Chance {
  Vec2 pixel, lamp;
  std::array<Vec2, 2> sky;
};

/// The samples of pixel (x, y), stratified: their places are Hammersley's points; lamp and sky have
/// an even sequence, shifted at random from pixel to pixel, alike for any order of the work.
void draw(int x, int y, std::span<Chance> samples);

/// A direction to a round lamp around the direction `lamp`; `spread`: tangent of half its diameter.
Vec3 towards_lamp(const Vec3& lamp, float spread, const Vec2& chance);

/// A direction above a surface, as often as its cosine with the normal.
Vec3 towards_sky(const Vec3& normal, const Vec2& chance);

}  // namespace gramloom
