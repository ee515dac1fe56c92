#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace gramloom {

/// What a MaterialX document says of a material: its pictures by what they are, relative to it.
struct MaterialXMaps {
  std::string name;               // "pebbles/quilting/seed1"
  std::filesystem::path colour;   // colours, as the file has them
  bool colour_is_linear = false;  // lin_rec709, else srgb_texture
  std::filesystem::path normal;   // numbers from here on; "": there is none. Green points up
  std::filesystem::path height, roughness, metalness, occlusion;
  double height_scale = 0;  // how high a height of 1 stands, in widths of the picture
};

/// The text of a MaterialX 1.38 document: a standard_surface with the colours, roughness, metalness
/// and normals, and a displacement by the height, as a material of this name (letters and digits of
/// it). A standard_surface has no ambient occlusion: where there is a map of it, the graph has it
/// as an output, "occlusion_output", that nothing uses. Without a roughness map it is 0.8.
std::string materialx_document(const MaterialXMaps& maps);

}  // namespace gramloom
