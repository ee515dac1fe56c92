#include "surface/volume.h"

#include "core/error.h"
#include "core/neighbour.h"

namespace gramloom {

namespace {

// The two cells around a coordinate of [0, 1], and the second's weight.
struct Between {
  int first;
  float weight;
};
Between between(float coordinate, int count) {
  const float at = coordinate * static_cast<float>(count) - 0.5f;
  const float below = std::floor(at);
  return {static_cast<int>(below), at - below};
}

Vec3 colour_of(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return image.channels < 3 ? Vec3{p[0], p[0], p[0]} : Vec3{p[0], p[1], p[2]};
}

}  // namespace

int index_outside(int i, int count, Outside outside) {
  if (i >= 0 && i < count) return i;
  if (outside == Outside::colour) return -1;
  if (outside == Outside::mirror) {
    const int back = neighbour(i, 2 * count, true);
    return back < count ? back : 2 * count - 1 - back;
  }
  return neighbour(i, count, outside == Outside::tile);
}

void check_volume(const Volume& volume) {
  if (volume.slices.size() < 2)
    throw Error("a volume is a stack of 2 slices or more, here {} given",
                volume.slices.size() == 1 ? "is 1" : "is none");
  const Image& first = volume.slices.front();
  for (const Image& slice : volume.slices)
    if (slice.size() != first.size() || slice.channels != first.channels)
      throw Error("slices of a volume have {}×{} pixels and {}×{} pixels: all must be alike",
                  first.width, first.height, slice.width, slice.height);
}

Vec3 trilinear(const Volume& volume, const Vec3& point, Outside outside, const Vec3& colour) {
  const Image& first = volume.slices.front();
  const int depth = static_cast<int>(volume.slices.size());
  const Between x = between(point.x, first.width), y = between(1 - point.y, first.height),
                z = between(point.z, depth);
  Vec3 sum;
  for (int corner = 0; corner < 8; ++corner) {
    const int right = corner & 1, down = corner >> 1 & 1, in = corner >> 2;
    const float weight = (right ? x.weight : 1 - x.weight) * (down ? y.weight : 1 - y.weight) *
                         (in ? z.weight : 1 - z.weight);
    const int i = index_outside(x.first + right, first.width, outside);
    const int j = index_outside(y.first + down, first.height, outside);
    const int k = index_outside(z.first + in, depth, outside);
    const bool beyond = i < 0 || j < 0 || k < 0;
    sum += (beyond ? colour : colour_of(volume.slices[static_cast<std::size_t>(k)], i, j)) * weight;
  }
  return sum;
}

}  // namespace gramloom
