#include "jobs/results.h"

#include "jobs/job_files.h"
#include "jobs/machine.h"

namespace gramloom {

namespace {

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

// Heights and masks have one channel and need finer steps than colours.
Encoding map_encoding(const Image& map, const Image& texture, const Encoding& encoding) {
  if (map.channels == texture.channels) return encoding;
  Encoding of_map;
  of_map.pixel_type =
      encoding.pixel_type == PixelType::uint8 ? PixelType::uint16 : encoding.pixel_type;
  return of_map;
}

}  // namespace

OutputFormat output_format(const Config& config, const Encoding& exemplar, int channels) {
  OutputFormat output{"", exemplar};
  if (config.pixel_type) output.encoding.pixel_type = *config.pixel_type;
  const FileFormat format = choose_format(config, output.encoding.pixel_type, channels);
  output.extension = fmt::format(".{}", to_word(format));
  if (!can_hold(format, channels))
    throw Error("a {} file cannot hold {} channels: choose format = \"tif\" or \"exr\"",
                to_word(format), channels);
  if (output.encoding.channel_names.size() != static_cast<std::size_t>(channels))
    output.encoding.channel_names.clear();
  return output;
}

std::vector<std::string> write_texture(const std::filesystem::path& folder, const std::string& name,
                                       const Texture& texture, const OutputFormat& format,
                                       const Json& settings) {
  Json made_by{{"gramloom", version()}};
  made_by.update(settings);
  const Metadata metadata{
      {"gramloom:settings", made_by.dump(-1, ' ', true, Json::error_handler_t::replace)}};

  std::vector<std::string> files{name + format.extension};
  write_image(folder / files.front(), texture.image, format.encoding, metadata);
  for (const auto& [map_name, map] : texture.maps) {
    files.push_back(fmt::format("{}_{}{}", name, map_name, format.extension));
    write_image(folder / files.back(), map, map_encoding(map, texture.image, format.encoding),
                metadata);
  }
  return files;
}

void write_exemplar(const std::filesystem::path& folder, const ImageFile& exemplar) {
  const OutputFormat format = output_format(Config(), exemplar.encoding, exemplar.image.channels);
  const std::string name = "exemplar" + format.extension;
  write_image(folder / name, exemplar.image, format.encoding);
  for (const std::string extension : {".png", ".exr", ".tif"})
    if (extension != format.extension) remove_file(folder / ("exemplar" + extension));
}

}  // namespace gramloom
