#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "jobs/config.h"
#include "jobs/exemplar.h"
#include "jobs/settings.h"

namespace gramloom {

/// The extension (".png") and encoding of a result of `config` whose exemplar was encoded like
/// this. Throws Error when the config's format cannot hold so many channels,
/// or a result of its size.
struct OutputFormat {
  std::string extension;
  Encoding encoding;
  float low =
      0;  // the values that become 0 and 1: those of a map beyond, where a file has integers
  float high = 1;
  std::optional<GreenAxis> green;  // of a map of normals
};
OutputFormat output_format(const Config& config, const Encoding& exemplar, int channels);

/// With the format's `low` as 0 and its `high` as 1.
Image scaled(Image map, const OutputFormat& format);

/// Whether files with this extension do not give back what was written.
bool is_lossy(const std::string& extension);
/// Whether values of this type come back from a file with this extension as they were. Throws Error
/// for an extension that is not written.
bool keeps_values(const std::string& extension, PixelType type);

/// Those of a texture and of its maps by name. A map of the exemplar's keeps its file's encoding;
/// one that the method thought of has the texture's, with finer steps where it has other channels;
/// one that is made of a height has the height's pixel type.
struct OutputFormats {
  OutputFormat picture;
  std::map<std::string, OutputFormat> maps;
};
OutputFormats output_formats(const Config& config, const std::vector<ExemplarFile>& files,
                             const Texture& texture);

/// The texture's maps of normals, and where their green points.
std::map<std::string, GreenAxis> normals_of(const OutputFormats& formats);

/// The names of a texture's files, its own first, and where they have other values than it: "file:
/// …", a line each.
struct WrittenTexture {
  std::vector<std::string> files;
  std::vector<std::string> notes;
};

/// The file of a texture's map; of the texture itself, which is no map, "".
std::string file_of_texture(const std::string& name, const std::string& map,
                            const OutputFormat& format);
/// What is written into such a file; `picture`: what the picture that was filled had.
Metadata texture_metadata(const OutputFormat& format, const Json& settings,
                          const Metadata& picture);
/// Where the file that was written last has other values.
void add_notes(WrittenTexture& written, const std::string& file, const OutputFormat& format,
               const std::vector<std::string>& notes);

/// Writes a texture and its maps as `name` + extension and `name`_<map> + extension in `folder`.
/// Their metadata is the settings, where normals' green points, what the `picture` that was filled
/// had, and nothing that differs from run to run.
WrittenTexture write_texture(const std::filesystem::path& folder, const std::string& name,
                             const Texture& texture, const OutputFormats& formats,
                             const Json& settings, const Metadata& picture = {});

}  // namespace gramloom
