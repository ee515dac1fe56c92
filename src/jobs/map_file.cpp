#include "jobs/map_file.h"

#include <cmath>

#include "runs/map_names.h"
#include "signal/normal_colours.h"

namespace gramloom {

namespace {

constexpr const char* green_mark = "gramloom:green";

// Of unit length but for the rounding of 8 bits, on 95 of 100 pixels, and out of the picture.
bool are_unit_vectors(const Image& map) {
  const Image picture = as_colours(map);
  std::size_t units = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) {
    const float x = 2 * picture.pixels[i] - 1, y = 2 * picture.pixels[i + 1] - 1,
                z = 2 * picture.pixels[i + 2] - 1;
    if (z > 0 && std::abs(std::sqrt(x * x + y * y + z * z) - 1) < 0.03f) ++units;
  }
  return units * 100 >= picture.pixels.size() / 3 * 95;
}

}  // namespace

std::optional<MapKind> usual_map(const std::string& name) {
  const auto of_three = kind_of_name(name, 3);
  return of_three == MapKind::normal ? of_three : kind_of_name(name, 1);
}

MapKind kind_of_map(const std::string& map, const MapFile& file, const Image& values) {
  if (file.kind) return *file.kind;
  if (const auto kind = kind_of_name(map, values.channels)) return *kind;
  if (const auto kind = kind_of_name(file.image.stem().string(), values.channels)) return *kind;
  if (values.channels != 3) return MapKind::scalar;
  return are_unit_vectors(values) ? MapKind::normal : MapKind::colour;
}

GreenAxis green_of_map(const std::string& map, const MapFile& file, const Metadata& metadata) {
  if (file.green) return *file.green;
  if (const auto green = green_of_name(map)) return *green;
  if (const auto green = green_of_name(file.image.stem().string())) return *green;
  const auto own = metadata.find(green_mark);
  const bool down = own != metadata.end() && own->second == to_word(GreenAxis::down);
  return down ? GreenAxis::down : GreenAxis::up;
}

Metadata green_metadata(GreenAxis green) { return {{green_mark, std::string(to_word(green))}}; }

}  // namespace gramloom
