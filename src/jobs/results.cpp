#include "jobs/results.h"

#include <algorithm>

#include "jobs/machine.h"
#include "jobs/names.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

FileFormat choose_format(const Config& config, PixelType type, int channels) {
  if (config.format != FileFormat::automatic) return config.format;
  if (channels > 4) return FileFormat::tif;
  const bool integer = type == PixelType::uint8 || type == PixelType::uint16;
  return integer ? FileFormat::png : FileFormat::exr;
}

bool can_hold(FileFormat format, int channels) {
  switch (format) {
    case FileFormat::png:
      return channels <= 4;
    case FileFormat::jpg:
      return channels == 1 || channels == 3;
    default:
      return true;
  }
}

// The format of an exemplar's map. An integer file has only 0 to 1: values beyond are scaled.
OutputFormat format_of_map(const Config& config, const ExemplarFile& file) {
  OutputFormat format = output_format(config, file.encoding, file.channels);
  if (file.kind == MapKind::normal) format.green = file.green;
  const PixelType stored = stored_type(format.extension, format.encoding.pixel_type);
  if (stored == PixelType::uint8 || stored == PixelType::uint16) {
    format.low = file.low;
    format.high = file.high;
  }
  return format;
}

// Heights and masks have one channel and need finer steps than colours.
OutputFormat format_of_own_map(const std::string& name, const Image& map, const Image& texture,
                               const OutputFormat& format) {
  if (map.channels == texture.channels && name != "height") return format;
  const PixelType type = format.encoding.pixel_type;
  return {
      format.extension, {type == PixelType::uint8 ? PixelType::uint16 : type, "", {}}, 0, 1, {}};
}

// The format of a map that is made of the height: with steps as fine as that one's.
OutputFormat format_of_made_map(const Config& config, const std::string& name, const Image& map,
                                const OutputFormat& height) {
  OutputFormat format = output_format(config, {height.encoding.pixel_type, "", {}}, map.channels);
  if (name == "normal") format.green = config.surface.green;
  return format;
}

}  // namespace

Image scaled(Image map, const OutputFormat& format) {
  if (format.low != 0 || format.high != 1)
    for (float& value : map.pixels) value = (value - format.low) / (format.high - format.low);
  return map;
}

OutputFormat output_format(const Config& config, const Encoding& exemplar, int channels) {
  OutputFormat output{"", exemplar, 0, 1, {}};
  if (config.pixel_type) output.encoding.pixel_type = *config.pixel_type;
  const FileFormat format = choose_format(config, output.encoding.pixel_type, channels);
  output.extension = fmt::format(".{}", to_word(format));
  if (!can_hold(format, channels))
    throw Error("a {} file cannot hold {} channels: choose format = \"tif\" or \"exr\"",
                to_word(format), channels);
  if (format == FileFormat::jpg &&
      std::max(config.size.width, config.size.height) > longest_side_of_jpeg)
    throw Error("a jpg file cannot hold {}×{} pixels, a side has at most {}: choose another format",
                config.size.width, config.size.height, longest_side_of_jpeg);
  if (output.encoding.channel_names.size() != static_cast<std::size_t>(channels))
    output.encoding.channel_names.clear();
  return output;
}

bool is_lossy(const std::string& extension) {
  const std::string small = in_small_letters(extension);
  return small == ".jpg" || small == ".jpeg" || small == ".webp" || small == ".hdr";
}

bool keeps_values(const std::string& extension, PixelType type) {
  const PixelType stored = stored_type(extension, type);
  if (is_lossy(extension)) return false;
  if (stored == type || stored == PixelType::float32) return true;
  return type == PixelType::uint8 && (stored == PixelType::uint16 || stored == PixelType::half);
}

OutputFormats output_formats(const Config& config, const std::vector<ExemplarFile>& files,
                             const Texture& texture) {
  const Encoding encoding = files.empty() ? Encoding() : files.front().encoding;
  OutputFormats formats{output_format(config, encoding, texture.image.channels), {}};
  for (const ExemplarFile& file : files)
    if (!file.map.empty()) formats.maps[file.map] = format_of_map(config, file);
  const std::vector<std::string> made = maps_asked(config.surface);
  for (const auto& [name, map] : texture.maps)
    if (!formats.maps.contains(name) && std::find(made.begin(), made.end(), name) == made.end())
      formats.maps[name] = format_of_own_map(name, map, texture.image, formats.picture);
  for (const std::string& name : made)
    if (texture.maps.contains(name))
      formats.maps[name] =
          format_of_made_map(config, name, texture.maps.at(name),
                             formats.maps.at(height_among(texture.maps, config.surface)));
  return formats;
}

std::map<std::string, GreenAxis> normals_of(const OutputFormats& formats) {
  std::map<std::string, GreenAxis> normals;
  for (const auto& [map, format] : formats.maps)
    if (format.green) normals[map] = *format.green;
  return normals;
}

std::string file_of_texture(const std::string& name, const std::string& map,
                            const OutputFormat& format) {
  return (map.empty() ? name : fmt::format("{}_{}", name, map)) + format.extension;
}

Metadata texture_metadata(const OutputFormat& format, const Json& settings,
                          const Metadata& picture) {
  Json made_by{{"gramloom", version()}};
  made_by.update(settings);
  Metadata metadata = format.green ? green_metadata(*format.green) : Metadata();
  metadata.insert(picture.begin(), picture.end());
  metadata["gramloom:settings"] = to_text(made_by, -1, true);
  return metadata;
}

void add_notes(WrittenTexture& written, const std::string& file, const OutputFormat& format,
               const std::vector<std::string>& notes) {
  for (const std::string& note : notes) written.notes.push_back(file + ": " + note);
  if (format.low != 0 || format.high != 1)
    written.notes.push_back(
        fmt::format("{}: 0 stands for {:g} and 1 for {:g}", file, format.low, format.high));
}

WrittenTexture write_texture(const fs::path& folder, const std::string& name,
                             const Texture& texture, const OutputFormats& formats,
                             const Json& settings, const Metadata& picture) {
  WrittenTexture written;
  const auto write = [&](const std::string& map, const Image& image, const OutputFormat& format) {
    const std::string file = file_of_texture(name, map, format);
    written.files.push_back(file);
    add_notes(written, file, format,
              write_image(folder / file, image, format.encoding,
                          texture_metadata(format, settings, map.empty() ? picture : Metadata())));
  };
  write("", texture.image, formats.picture);
  for (const auto& [map_name, map] : texture.maps) {
    const OutputFormat& format = formats.maps.at(map_name);
    write(map_name, scaled(map, format), format);
  }
  return written;
}

}  // namespace gramloom
