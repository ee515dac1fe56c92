#include "jobs/map_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

namespace gramloom {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_capital(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// The words of a name in small letters: "Bricks_NormalDX-2" has "bricks", "normal" and "dx".
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  char before = ' ';
  for (const char c : name) {
    if (!is_letter(c) || (is_capital(c) && !is_capital(before))) words.emplace_back();
    if (is_letter(c))
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    before = c;
  }
  return words;
}

template <std::size_t n>
bool has_word(const std::string& name, const std::array<std::string_view, n>& known) {
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(known.begin(), known.end(), word) != known.end();
  });
}

constexpr auto normal_words =
    std::to_array<std::string_view>({"normal", "normals", "nrm", "nor", "norm", "normalmap"});
constexpr auto alpha_words =
    std::to_array<std::string_view>({"alpha", "opacity", "mask", "transparency", "coverage"});
constexpr auto colour_words = std::to_array<std::string_view>(
    {"colour", "color", "albedo", "diffuse", "basecolor", "emission", "emissive", "specular"});
constexpr auto scalar_words = std::to_array<std::string_view>(
    {"height", "displacement", "disp", "bump", "depth", "roughness", "rough", "gloss", "metalness",
     "metallic", "occlusion", "ao", "cavity", "curvature", "orm", "arm", "rma", "mra"});
constexpr auto down_words = std::to_array<std::string_view>({"dx", "directx"});

// Such a map of that many channels.
std::optional<MapKind> kind_of_name(const std::string& name, int channels) {
  if (has_word(name, normal_words) && channels >= 3) return MapKind::normal;
  if (has_word(name, alpha_words) && channels == 1) return MapKind::alpha;
  if (has_word(name, colour_words)) return MapKind::colour;
  if (has_word(name, scalar_words)) return MapKind::scalar;
  return std::nullopt;
}

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
  if (has_word(name, normal_words)) return MapKind::normal;
  if (has_word(name, alpha_words)) return MapKind::alpha;
  return kind_of_name(name, 0);
}

MapKind kind_of_map(const std::string& map, const MapFile& file, const Image& values) {
  if (file.kind) return *file.kind;
  if (const auto kind = kind_of_name(map, values.channels)) return *kind;
  if (const auto kind = kind_of_name(file.image.stem().string(), values.channels)) return *kind;
  if (values.channels != 3) return MapKind::scalar;
  return are_unit_vectors(values) ? MapKind::normal : MapKind::colour;
}

GreenAxis green_of_map(const std::string& map, const MapFile& file) {
  if (file.green) return *file.green;
  const bool down = has_word(map, down_words) || has_word(file.image.stem().string(), down_words);
  return down ? GreenAxis::down : GreenAxis::up;
}

}  // namespace gramloom
