#include "surface/export/gltf.h"

#include <algorithm>
#include <cstring>

#include "io/image_file.h"
#include "io/json_text.h"
#include "io/text_file.h"
#include "surface/export/gltf_shapes.h"
#include "surface/normal_map.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// The standard's numbers.
constexpr int float_type = 5126, unsigned_short = 5123;
constexpr int vertices = 34962, indices = 34963;
constexpr int linear_filter = 9729, linear_mipmap_filter = 9987;
constexpr int repeat = 10497, mirrored_repeat = 33648;

fs::path with_suffix(const fs::path& stem, const std::string& suffix) {
  fs::path file = stem;
  file += suffix;
  return file;
}

// A file's name as a relative reference (RFC 3986).
std::string as_uri(const fs::path& file) {
  std::string uri;
  for (const char c : file.filename().string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.' || c == '~';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

// --- the shapes ---------------------------------------------------------------------------------

struct Geometry {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array(), meshes = Json::array();
};

template <class T>
int add_accessor(Geometry& geometry, const std::vector<T>& values, int component, const char* type,
                 int target) {
  geometry.bytes.resize((geometry.bytes.size() + 3) / 4 * 4);
  const std::size_t length = values.size() * sizeof(T);
  geometry.views.push_back({{"buffer", 0},
                            {"byteOffset", geometry.bytes.size()},
                            {"byteLength", length},
                            {"target", target}});
  geometry.bytes.append(reinterpret_cast<const char*>(values.data()), length);
  geometry.accessors.push_back({{"bufferView", geometry.views.size() - 1},
                                {"componentType", component},
                                {"count", values.size()},
                                {"type", type}});
  return static_cast<int>(geometry.accessors.size()) - 1;
}

void add_mesh(Geometry& geometry, const std::string& name, const ExportMesh& mesh) {
  const int positions = add_accessor(geometry, mesh.positions, float_type, "VEC3", vertices);
  std::array<float, 3> low = mesh.positions.front(), high = low;
  for (const auto& point : mesh.positions)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  geometry.accessors.back()["min"] = low;
  geometry.accessors.back()["max"] = high;
  const int normals = add_accessor(geometry, mesh.normals, float_type, "VEC3", vertices);
  const int tangents = add_accessor(geometry, mesh.tangents, float_type, "VEC4", vertices);
  const int coordinates = add_accessor(geometry, mesh.coordinates, float_type, "VEC2", vertices);
  const int triangles = add_accessor(geometry, mesh.triangles, unsigned_short, "SCALAR", indices);
  geometry.meshes.push_back({{"name", name},
                             {"primitives",
                              {{{"attributes",
                                 {{"POSITION", positions},
                                  {"NORMAL", normals},
                                  {"TANGENT", tangents},
                                  {"TEXCOORD_0", coordinates}}},
                                {"indices", triangles},
                                {"material", 0}}}}});
}

// --- the pictures -------------------------------------------------------------------------------

struct Pictures {
  std::vector<fs::path> files;
  Json images = Json::array(), textures = Json::array();

  // Writes one; the texture that shows it.
  int add(const fs::path& file, const Image& image) {
    write_image(file, image, {});
    files.push_back(file);
    images.push_back({{"uri", as_uri(file)}, {"mimeType", "image/png"}});
    textures.push_back({{"sampler", 0}, {"source", images.size() - 1}});
    return static_cast<int>(textures.size()) - 1;
  }
};

Image packed_maps(const MaterialSet& material) {
  Image packed(material.colour.size(), 3);
  const auto value = [](const std::optional<Image>& map, std::size_t i, float otherwise) {
    return map ? map->pixels[i] : otherwise;
  };
  for (std::size_t i = 0; 3 * i < packed.pixels.size(); ++i) {
    packed.pixels[3 * i] = value(material.occlusion, i, 1);
    packed.pixels[3 * i + 1] = value(material.roughness, i, static_cast<float>(usual_roughness));
    packed.pixels[3 * i + 2] = value(material.metalness, i, 0);
  }
  return packed;
}

std::optional<Image> normals_of(const MaterialSet& material) {
  if (material.normal) return material.normal;
  if (!material.height) return std::nullopt;
  return normals_from_height(*material.height, material.strength, material.tile);
}

Json material_json(const fs::path& stem, const MaterialSet& material, Pictures& pictures) {
  Json surface{{"baseColorTexture",
                {{"index", pictures.add(with_suffix(stem, "_base_color.png"), material.colour)}}}};
  Json json{{"name", material.name}};
  if (material.occlusion || material.roughness || material.metalness) {
    const int packed = pictures.add(with_suffix(stem, "_occlusion_roughness_metalness.png"),
                                    packed_maps(material));
    surface["metallicRoughnessTexture"] = {{"index", packed}};
    if (material.occlusion) json["occlusionTexture"] = {{"index", packed}};
  } else {
    surface["metallicFactor"] = 0;
    surface["roughnessFactor"] = usual_roughness;
  }
  json["pbrMetallicRoughness"] = surface;
  if (const auto normals = normals_of(material))
    json["normalTexture"] = {{"index", pictures.add(with_suffix(stem, "_normal_texture.png"),
                                                    normals_to_colours(*normals, GreenAxis::up))}};
  if (material.colour.channels == 4) json["alphaMode"] = "BLEND";
  json["doubleSided"] = true;
  return json;
}

}  // namespace

std::vector<fs::path> gltf_files(const fs::path& stem) {
  std::vector<fs::path> files;
  for (const auto* suffix : {".gltf", ".bin", "_base_color.png",
                             "_occlusion_roughness_metalness.png", "_normal_texture.png"})
    files.push_back(with_suffix(stem, suffix));
  return files;
}

std::vector<fs::path> write_gltf(const fs::path& stem, const MaterialSet& material,
                                 const std::string& generator) {
  Geometry geometry;
  add_mesh(geometry, "ball", export_ball());
  add_mesh(geometry, "plane", export_plane());
  Pictures pictures;
  const Json materials = Json::array({material_json(stem, material, pictures)});
  const fs::path bytes = with_suffix(stem, ".bin"), document = with_suffix(stem, ".gltf");
  write_text(bytes, geometry.bytes);

  const auto wrap = [](bool tiles) { return tiles ? repeat : mirrored_repeat; };
  const Json json{{"asset", {{"version", "2.0"}, {"generator", generator}}},
                  {"scene", 0},
                  {"scenes", {{{"name", material.name}, {"nodes", {0, 1}}}}},
                  {"nodes",
                   {{{"name", "ball"}, {"mesh", 0}, {"translation", {-1.1, 0, 0}}},
                    {{"name", "plane"}, {"mesh", 1}, {"translation", {1.1, 0, 0}}}}},
                  {"meshes", geometry.meshes},
                  {"materials", materials},
                  {"textures", pictures.textures},
                  {"images", pictures.images},
                  {"samplers",
                   {{{"magFilter", linear_filter},
                     {"minFilter", linear_mipmap_filter},
                     {"wrapS", wrap(tiles_x(material.tile))},
                     {"wrapT", wrap(tiles_y(material.tile))}}}},
                  {"accessors", geometry.accessors},
                  {"bufferViews", geometry.views},
                  {"buffers", {{{"uri", as_uri(bytes)}, {"byteLength", geometry.bytes.size()}}}}};
  write_text(document, to_text(json, 2) + "\n");
  std::vector<fs::path> files{document, bytes};
  files.insert(files.end(), pictures.files.begin(), pictures.files.end());
  return files;
}

}  // namespace gramloom
