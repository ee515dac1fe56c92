#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/field_values.h"
#include "io/image_file.h"
#include "jobs/map_file.h"
#include "surface/preview.h"

namespace gramloom {

/// What a preview of files is made of.
struct PreviewWork {
  /// Pictures of one or two textures with their maps, names of procedural textures, or slices.
  std::vector<std::string> images;
  NamedFiles<MapFile> maps;      // of the first texture
  std::vector<std::string> set;  // "key=value": parameters of the procedural textures
  PreviewParams params;
};

/// A picture's colours as linear values. Those of 8 and 16 bits are coded as sRGB.
Image read_colours(const std::filesystem::path& file);
/// The surroundings that the params name, a sky box of six files as a strip; empty where there are
/// none.
Image read_environment(const PreviewParams& params);
inline bool is_coded(PixelType type) {
  return type == PixelType::uint8 || type == PixelType::uint16;
}

/// The files of a texture by its maps, the picture's own by "": the picture of this name, and what
/// lies beside it. None of a procedural texture.
std::map<std::string, std::filesystem::path> texture_files(const FileOrName& texture,
                                                           const PreviewParams& params);
/// That texture, or the procedural one of this name, for such a preview. Throws Error for what
/// cannot be read, ConfigError for a name that no procedural texture has.
PreviewMaterial read_texture(const FileOrName& texture, const PreviewParams& params);

struct PreviewFile {
  std::vector<std::string> used;  // maps that were found beside the pictures: a line each
};

/// Renders what the work says and writes it. A picture named like another and a map
/// ("wall_height.png") is that one's map, and such files beside a picture are found; other pictures
/// are textures of their own, at most two. Throws ConfigError for what the user must change, files
/// that cannot be read among it, before anything is rendered; Error for what cannot be written;
/// Interrupted when the progress says stop, and then nothing is written.
PreviewFile make_preview(const PreviewWork& work, const std::filesystem::path& output,
                         const Control& control);

}  // namespace gramloom
