#pragma once

#include <filesystem>
#include <vector>

#include "surface/export/material_set.h"

namespace gramloom {

/// Writes the material as glTF 2.0 (Khronos; ISO/IEC 12113:2022) on a ball and a plane beside it:
/// `stem`.gltf and beside it
///   stem_base_color.png           8-bit sRGB, with alpha where the colours have it (blended)
///   stem_occlusion_roughness_metalness.png  linear: occlusion in red, roughness in green,
///   metalness
///                                 in blue, as the standard packs them; without maps there is none,
///                                 and roughness is 0.8, metalness 0
///   stem_normal_texture.png       linear; green points up (OpenGL). Made of the height where there
///                                 are no normals
///   stem.bin                      the two shapes, with tangents
/// No name is one that `gramloom export --target materialx` writes: both may share a folder.
/// The standard has no displacement: a height goes into the normals alone. Pictures repeat on axes
/// on which they tile, and are mirrored on others. Returns the files, the document first. Throws
/// Error for a file that cannot be written.
std::vector<std::filesystem::path> write_gltf(const std::filesystem::path& stem,
                                              const MaterialSet& material,
                                              const std::string& generator);

/// What write_gltf() writes beside the given stem, whether or not the material needs it.
std::vector<std::filesystem::path> gltf_files(const std::filesystem::path& stem);

}  // namespace gramloom
