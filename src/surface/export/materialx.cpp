#include "surface/export/materialx.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "surface/export/material_set.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// A name that MaterialX allows: letters, digits and underscores.
std::string valid_name(const std::string& name) {
  std::string valid;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    valid += plain ? c : '_';
  }
  return valid;
}

pugi::xml_node add(pugi::xml_node parent, const char* category, const std::string& name,
                   const char* type) {
  pugi::xml_node node = parent.append_child(category);
  node.append_attribute("name") = name.c_str();
  if (*type != '\0') node.append_attribute("type") = type;
  return node;
}

void set_value(pugi::xml_node node, const char* input, const char* type, const std::string& value) {
  add(node, "input", input, type).append_attribute("value") = value.c_str();
}

// A picture in the graph, and an output of the graph that has it.
class Graph {
 public:
  Graph(pugi::xml_node document, const std::string& name)
      : node_(add(document, "nodegraph", "NG_" + name, "")) {}

  std::string name() const { return node_.attribute("name").value(); }

  void add_picture(const std::string& name, const char* type, const fs::path& file,
                   const char* colour_space) {
    if (file.empty()) return;
    const pugi::xml_node image = add(node_, "image", name, type);
    pugi::xml_node input = add(image, "input", "file", "filename");
    input.append_attribute("value") = file.generic_string().c_str();
    if (*colour_space != '\0') input.append_attribute("colorspace") = colour_space;
  }
  void add_normal(const std::string& name, const std::string& picture) {
    const pugi::xml_node node = add(node_, "normalmap", name, "vector3");
    add(node, "input", "in", "vector3").append_attribute("nodename") = picture.c_str();
  }
  void add_output(const std::string& of, const char* type) {
    add(node_, "output", of + "_output", type).append_attribute("nodename") = of.c_str();
  }

 private:
  pugi::xml_node node_;
};

void connect(pugi::xml_node node, const char* input, const char* type, const Graph& graph,
             const std::string& output) {
  pugi::xml_node connected = add(node, "input", input, type);
  connected.append_attribute("nodegraph") = graph.name().c_str();
  connected.append_attribute("output") = (output + "_output").c_str();
}

Graph add_graph(pugi::xml_node document, const std::string& name, const MaterialXMaps& maps) {
  Graph graph(document, name);
  graph.add_picture("base_color", "color3", maps.colour,
                    maps.colour_is_linear ? "lin_rec709" : "srgb_texture");
  graph.add_picture("normal_picture", "vector3", maps.normal, "");
  if (!maps.normal.empty()) graph.add_normal("normal", "normal_picture");
  graph.add_picture("roughness", "float", maps.roughness, "");
  graph.add_picture("metalness", "float", maps.metalness, "");
  graph.add_picture("height", "float", maps.height, "");
  graph.add_picture("occlusion", "float", maps.occlusion, "");
  graph.add_output("base_color", "color3");
  if (!maps.normal.empty()) graph.add_output("normal", "vector3");
  if (!maps.roughness.empty()) graph.add_output("roughness", "float");
  if (!maps.metalness.empty()) graph.add_output("metalness", "float");
  if (!maps.height.empty()) graph.add_output("height", "float");
  if (!maps.occlusion.empty()) graph.add_output("occlusion", "float");
  return graph;
}

}  // namespace

std::string materialx_document(const MaterialXMaps& maps) {
  pugi::xml_document xml;
  xml.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
  pugi::xml_node document = xml.append_child("materialx");
  document.append_attribute("version") = "1.38";
  const std::string name = valid_name(maps.name);
  const Graph graph = add_graph(document, name, maps);

  const pugi::xml_node surface = add(document, "standard_surface", "SR_" + name, "surfaceshader");
  set_value(surface, "base", "float", "1");
  connect(surface, "base_color", "color3", graph, "base_color");
  if (maps.roughness.empty())
    set_value(surface, "specular_roughness", "float", fmt::format("{}", usual_roughness));
  else
    connect(surface, "specular_roughness", "float", graph, "roughness");
  if (!maps.metalness.empty()) connect(surface, "metalness", "float", graph, "metalness");
  if (!maps.normal.empty()) connect(surface, "normal", "vector3", graph, "normal");
  if (!maps.height.empty()) {
    const pugi::xml_node displacement =
        add(document, "displacement", "DS_" + name, "displacementshader");
    connect(displacement, "displacement", "float", graph, "height");
    set_value(displacement, "scale", "float", fmt::format("{}", maps.height_scale));
  }
  const pugi::xml_node material = add(document, "surfacematerial", "M_" + name, "material");
  add(material, "input", "surfaceshader", "surfaceshader").append_attribute("nodename") =
      ("SR_" + name).c_str();
  if (!maps.height.empty())
    add(material, "input", "displacementshader", "displacementshader")
        .append_attribute("nodename") = ("DS_" + name).c_str();
  std::ostringstream text;
  xml.save(text, "  ");
  return text.str();
}

}  // namespace gramloom
