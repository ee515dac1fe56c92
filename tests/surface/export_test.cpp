#include <gmock/gmock.h>
#include <tiny_gltf.h>
#include <unistd.h>

#include <filesystem>
#include <pugixml.hpp>

#include "io/image_file.h"
#include "io/text_file.h"
#include "surface/export/gltf.h"
#include "surface/export/gltf_shapes.h"
#include "surface/export/materialx.h"
#include "surface/normal_map.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Export : public testing::Test {
 protected:
  Export() : folder_(fs::temp_directory_path() / fmt::format("gramloom_export_{}", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Export() override { fs::remove_all(folder_); }

  static MaterialSet material() {
    MaterialSet set;
    set.name = "a stone/q/seed1";
    set.colour = Image(16, 12, 3, 0.5f);
    set.roughness = Image(16, 12, 1, 0.25f);
    set.occlusion = Image(16, 12, 1, 0.75f);
    set.height = Image(16, 12, 1);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x) *set.height->at(x, y) = static_cast<float>(x) / 16;
    set.strength = 4;
    set.tile = Tile::y;
    return set;
  }
  static tinygltf::Model read(const fs::path& file) {
    tinygltf::Model model;
    std::string errors, warnings;
    tinygltf::TinyGLTF reader;
    EXPECT_TRUE(reader.LoadASCIIFromFile(&model, &errors, &warnings, file.string()));
    EXPECT_EQ(errors + warnings, "");
    return model;
  }

  const fs::path folder_;
};

TEST_F(Export, AGltfReaderFindsTheMaterial) {
  const auto files = write_gltf(folder_ / "it's 100% ü", material(), "gramloom test");
  for (const fs::path& file : files) EXPECT_TRUE(fs::is_regular_file(file)) << file;
  const tinygltf::Model model = read(files.front());
  ASSERT_EQ(model.materials.size(), 1u);
  const tinygltf::Material& found = model.materials[0];
  EXPECT_EQ(found.name, "a stone/q/seed1");
  const auto image = [&](int texture) {
    return model
        .images[static_cast<std::size_t>(model.textures[static_cast<std::size_t>(texture)].source)];
  };
  const int colour = found.pbrMetallicRoughness.baseColorTexture.index;
  const int packed = found.pbrMetallicRoughness.metallicRoughnessTexture.index;
  EXPECT_EQ(found.occlusionTexture.index, packed);
  EXPECT_EQ(image(colour).width, 16);
  EXPECT_EQ(image(colour).height, 12);
  const auto& maps = image(packed).image;
  EXPECT_EQ(maps[0], 191) << "occlusion in red";
  EXPECT_EQ(maps[1], 64) << "roughness in green";
  EXPECT_EQ(maps[2], 0) << "metalness in blue";
  const auto& normals = image(found.normalTexture.index).image;
  EXPECT_LT(normals[4 * 8], 110) << "the height rises to the right";
  EXPECT_NEAR(normals[4 * 8 + 1], 128, 1);
  ASSERT_EQ(model.samplers.size(), 1u);
  EXPECT_EQ(model.samplers[0].wrapS, TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT);
  EXPECT_EQ(model.samplers[0].wrapT, TINYGLTF_TEXTURE_WRAP_REPEAT);
  EXPECT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.scenes[0].nodes.size(), 2u);
}

TEST_F(Export, WithoutMapsThereIsOnlyTheColour) {
  MaterialSet set;
  set.name = "plain";
  set.colour = Image(8, 8, 4, 0.5f);
  const auto files = write_gltf(folder_ / "plain", set, "gramloom test");
  EXPECT_EQ(files.size(), 3u);
  const tinygltf::Material found = read(files.front()).materials.at(0);
  EXPECT_EQ(found.normalTexture.index, -1);
  EXPECT_EQ(found.pbrMetallicRoughness.metallicRoughnessTexture.index, -1);
  EXPECT_EQ(found.pbrMetallicRoughness.metallicFactor, 0);
  EXPECT_EQ(found.alphaMode, "BLEND");
}

// Counterclockwise from outside, normals outwards, tangents to the right in the picture.
TEST(ExportMesh, FacesOutwards) {
  for (const ExportMesh& mesh : {export_ball(), export_plane()}) {
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const std::size_t corners[] = {mesh.triangles[i], mesh.triangles[i + 1],
                                     mesh.triangles[i + 2]};
      std::array<float, 3> a{}, b{};
      for (std::size_t k = 0; k < 3; ++k) {
        a[k] = mesh.positions[corners[1]][k] - mesh.positions[corners[0]][k];
        b[k] = mesh.positions[corners[2]][k] - mesh.positions[corners[0]][k];
      }
      const auto& n = mesh.normals[corners[0]];
      const float volume = n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2]) +
                           n[2] * (a[0] * b[1] - a[1] * b[0]);
      ASSERT_GT(volume, 0) << i;
    }
    for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) {
      const auto& t = mesh.tangents[i];
      const auto& n = mesh.normals[i];
      ASSERT_NEAR(t[0] * n[0] + t[1] * n[1] + t[2] * n[2], 0, 1e-6f);
      ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-6f);
      if (mesh.coordinates[i + 1][1] != mesh.coordinates[i][1]) continue;
      float along = 0;
      for (std::size_t k = 0; k < 3; ++k)
        along += t[k] * (mesh.positions[i + 1][k] - mesh.positions[i][k]);
      ASSERT_GE(along, -1e-6f);
    }
  }
}

TEST(MaterialX, EveryConnectionLeadsSomewhere) {
  const std::string text =
      materialx_document({"it's/a \"stone\"/seed1", "seed1.png", false, "seed1_normal.png",
                          "a & b.exr", "r.png", "m.png", "o.png", 0.25});
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(text.c_str()));
  const pugi::xml_node document = xml.child("materialx");
  EXPECT_STREQ(document.attribute("version").value(), "1.38");
  const auto named = [](pugi::xml_node parent, const std::string& name) {
    return parent.find_child_by_attribute("name", name.c_str());
  };
  int connections = 0;
  const auto check = [&](auto&& self, pugi::xml_node scope, pugi::xml_node node) -> void {
    for (const pugi::xml_node child : node.children()) {
      if (const pugi::xml_attribute to = child.attribute("nodename")) {
        EXPECT_TRUE(named(scope, to.value())) << to.value();
        EXPECT_STREQ(named(scope, to.value()).attribute("type").value(),
                     child.attribute("type").value());
        ++connections;
      }
      if (const pugi::xml_attribute graph = child.attribute("nodegraph")) {
        const pugi::xml_node output =
            named(named(document, graph.value()), child.attribute("output").value());
        EXPECT_STREQ(output.attribute("type").value(), child.attribute("type").value());
        ++connections;
      }
      self(self, std::string(child.name()) == "nodegraph" ? child : scope, child);
    }
  };
  check(check, document, document);
  EXPECT_EQ(connections, 1 + 6 + 4 + 1 + 2);
  const pugi::xml_node graph = document.child("nodegraph");
  EXPECT_STREQ(named(graph, "base_color").child("input").attribute("colorspace").value(),
               "srgb_texture");
  EXPECT_FALSE(named(graph, "roughness").child("input").attribute("colorspace"));
  EXPECT_STREQ(named(graph, "height").child("input").attribute("value").value(), "a & b.exr");
  for (const pugi::xml_node node : document.children())
    for (const char c : std::string(node.attribute("name").value()))
      EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) || c == '_');
}

}  // namespace
}  // namespace gramloom
