#include "surface/mesh_file.h"

#include <tiny_obj_loader.h>

#include <charconv>
#include <fstream>
#include <map>

#include "core/error.h"
#include "io/regular_file.h"
#include "io/text_file.h"
#include "surface/surface_module.h"

namespace gramloom::surface_module {

namespace {

// A corner's place, normal and coordinates as the file numbers them.
using Corner = std::array<int, 3>;

class Builder {
 public:
  Builder(const tinyobj::attrib_t& attributes, const std::string& name)
      : attributes_(attributes), name_(name) {}

  std::uint32_t vertex(const tinyobj::index_t& index) {
    check(index.vertex_index, attributes_.vertices.size() / 3, "vertex");
    if (index.texcoord_index < 0) has_coordinates_ = false;
    if (index.normal_index < 0) has_normals_ = false;
    const Corner corner{index.vertex_index, index.normal_index, index.texcoord_index};
    const auto [at, added] = made_.try_emplace(corner, mesh.positions.size());
    if (!added) return at->second;
    mesh.positions.push_back(vector(attributes_.vertices, index.vertex_index));
    mesh.normals.push_back(index.normal_index < 0
                               ? Vec3{}
                               : normalised(vector(attributes_.normals, index.normal_index)));
    mesh.coordinates.push_back(
        index.texcoord_index < 0 ? Vec2{} : pair(attributes_.texcoords, index.texcoord_index));
    return at->second;
  }

  Mesh finished() {
    if (!has_coordinates_) mesh.coordinates.clear();
    check_mesh(mesh, name_);
    mesh = fitted(std::move(mesh));  // then what is near is so in any unit of length
    if (!has_normals_) mesh.normals = smooth_normals(mesh, NormalWeights::angle);
    return std::move(mesh);
  }

  Mesh mesh;

 private:
  void check(int index, std::size_t count, std::string_view what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= count)
      throw Error("{}: a face names {} {}, the file has {}", name_, what, index + 1, count);
  }
  Vec3 vector(const std::vector<tinyobj::real_t>& values, int index) const {
    check(index, values.size() / 3, "normal");
    const auto i = static_cast<std::size_t>(index) * 3;
    return {values[i], values[i + 1], values[i + 2]};
  }
  Vec2 pair(const std::vector<tinyobj::real_t>& values, int index) const {
    check(index, values.size() / 2, "coordinate");
    const auto i = static_cast<std::size_t>(index) * 2;
    return {values[i], values[i + 1]};
  }

  const tinyobj::attrib_t& attributes_;
  const std::string& name_;
  std::map<Corner, std::uint32_t> made_;
  bool has_coordinates_ = true, has_normals_ = true;
};

// The word that is not a finite number of a line of a vertex, if there is one.
std::string_view bad_number(std::string_view line) {
  line.remove_prefix(line.find_first_of(" \t"));
  while (true) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == line.npos || line[begin] == '#') return {};
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r"));
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    float value = 0;
    const auto [end, wrong] = std::from_chars(digits.begin(), digits.end(), value);
    // What is too small for a float is zero.
    const bool small = wrong == std::errc::result_out_of_range && digits.find("e-") != digits.npos;
    if (!small && (wrong != std::errc() || end != digits.end() || !std::isfinite(value)))
      return word;
    line.remove_prefix(word.size());
  }
}

// tinyobjloader takes what is no number for 0, and needs hundreds of bytes a face: both are looked
// for before.
void check_lines(std::ifstream& file, const std::string& name) {
  std::size_t faces = 0, number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string_view text =
        std::string_view(line).substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (text.starts_with("f ") || text.starts_with("f\t")) ++faces;
    const bool vertex = text.starts_with("v ") || text.starts_with("v\t") ||
                        text.starts_with("vn ") || text.starts_with("vt ");
    if (!vertex) continue;
    if (const auto word = bad_number(text); !word.empty())
      throw Error("{}:{}: '{}' is not a finite number", name, number, word);
  }
  if (faces > most_triangles)
    throw Error("{}: a mesh of {} faces, allowed are {}", name, faces, most_triangles);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  const std::string name = path.string();
  const RegularFile file = [&] {
    try {
      return RegularFile(path);
    } catch (const Error& error) {
      throw Error("{}: {}", name, error.what());
    }
  }();
  std::ifstream lines(file.name());
  check_lines(lines, name);
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  // Of a text, no material's file is opened: we need none, and beside the opened file, whose name
  // is that of a descriptor, its name could be that of any other one.
  if (!reader.ParseFromString(read_text(file.name()), "", config)) {
    const std::string& why = reader.Error();
    throw Error("{}: not a mesh that can be read{}{}", name, why.empty() ? "" : ": ",
                why.substr(0, why.find('\n')));
  }
  Builder builder(reader.GetAttrib(), name);
  for (const auto& shape : reader.GetShapes())
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = builder.vertex(shape.mesh.indices[i + k]);
      builder.mesh.triangles.push_back(triangle);
    }
  return builder.finished();
}

}  // namespace gramloom::surface_module
