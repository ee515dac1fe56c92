#include "runs/map_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace gramloom {

namespace {

// A word that names of maps have, what the values are, and which map of a material it is, if one.
struct MapWord {
  std::string_view word;
  MapKind kind;
  std::string_view map = "";
};
constexpr auto map_words = std::to_array<MapWord>({
    {"normal", MapKind::normal, "normal"},
    {"normals", MapKind::normal, "normal"},
    {"nrm", MapKind::normal, "normal"},
    {"nor", MapKind::normal, "normal"},
    {"norm", MapKind::normal, "normal"},
    {"normalmap", MapKind::normal, "normal"},
    {"alpha", MapKind::alpha},
    {"opacity", MapKind::alpha},
    {"mask", MapKind::alpha},
    {"transparency", MapKind::alpha},
    {"coverage", MapKind::alpha},
    {"colour", MapKind::colour},
    {"color", MapKind::colour},
    {"albedo", MapKind::colour},
    {"diffuse", MapKind::colour},
    {"basecolor", MapKind::colour},
    {"emission", MapKind::colour},
    {"emissive", MapKind::colour},
    {"specular", MapKind::colour},
    {"height", MapKind::scalar, "height"},
    {"displacement", MapKind::scalar, "height"},
    {"disp", MapKind::scalar, "height"},
    {"bump", MapKind::scalar, "height"},
    {"depth", MapKind::scalar},
    {"roughness", MapKind::scalar, "roughness"},
    {"rough", MapKind::scalar, "roughness"},
    {"gloss", MapKind::scalar},
    {"metalness", MapKind::scalar, "metalness"},
    {"metallic", MapKind::scalar, "metalness"},
    {"metal", MapKind::scalar, "metalness"},
    {"occlusion", MapKind::scalar, "occlusion"},
    {"ao", MapKind::scalar, "occlusion"},
    {"cavity", MapKind::scalar},
    {"curvature", MapKind::scalar},
    {"orm", MapKind::scalar},
    {"arm", MapKind::scalar},
    {"rma", MapKind::scalar},
    {"mra", MapKind::scalar},
});

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

bool has_word(const std::vector<std::string>& words, std::string_view known) {
  return std::ranges::find(words, known) != words.end();
}

bool has_word_of(const std::vector<std::string>& words, MapKind kind) {
  return std::ranges::any_of(map_words, [&](const MapWord& known) {
    return known.kind == kind && has_word(words, known.word);
  });
}

}  // namespace

std::optional<MapKind> kind_of_name(const std::string& name, int channels) {
  const std::vector<std::string> words = words_of(name);
  if (channels >= 3 && has_word_of(words, MapKind::normal)) return MapKind::normal;
  if (channels == 1 && has_word_of(words, MapKind::alpha)) return MapKind::alpha;
  for (const MapKind kind : {MapKind::colour, MapKind::scalar})
    if (has_word_of(words, kind)) return kind;
  return std::nullopt;
}

std::optional<GreenAxis> green_of_name(const std::string& name) {
  const std::vector<std::string> words = words_of(name);
  if (has_word(words, "dx") || has_word(words, "directx")) return GreenAxis::down;
  if (has_word(words, "gl") || has_word(words, "opengl")) return GreenAxis::up;
  return std::nullopt;
}

std::string material_map(const std::string& map) {
  if (map == "ambient_occlusion") return "occlusion";
  const auto known = std::ranges::find(map_words, std::string_view(map), &MapWord::word);
  return known == map_words.end() ? "" : std::string(known->map);
}

}  // namespace gramloom
