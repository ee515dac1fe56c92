#include "jobs/results.h"

#include <algorithm>

#include "jobs/machine.h"
#include "runs/job_files.h"

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

// Heights and masks have one channel and need finer steps than colours.
OutputFormat format_of_own_map(const Image& map, const Image& texture, const OutputFormat& format) {
  if (map.channels == texture.channels) return format;
  const PixelType type = format.encoding.pixel_type;
  return {format.extension, {type == PixelType::uint8 ? PixelType::uint16 : type, "", {}}};
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
  if (format == FileFormat::jpg &&
      std::max(config.size.width, config.size.height) > longest_side_of_jpeg)
    throw Error("a jpg file cannot hold {}×{} pixels, a side has at most {}: choose another format",
                config.size.width, config.size.height, longest_side_of_jpeg);
  if (output.encoding.channel_names.size() != static_cast<std::size_t>(channels))
    output.encoding.channel_names.clear();
  return output;
}

OutputFormats output_formats(const Config& config, const std::vector<ExemplarFile>& files,
                             const Texture& texture) {
  const Encoding encoding = files.empty() ? Encoding() : files.front().encoding;
  OutputFormats formats{output_format(config, encoding, texture.image.channels), {}};
  for (const ExemplarFile& file : files)
    if (!file.map.empty())
      formats.maps[file.map] = output_format(config, file.encoding, file.channels);
  for (const auto& [name, map] : texture.maps)
    if (!formats.maps.contains(name))
      formats.maps[name] = format_of_own_map(map, texture.image, formats.picture);
  return formats;
}

std::vector<std::string> write_texture(const fs::path& folder, const std::string& name,
                                       const Texture& texture, const OutputFormats& formats,
                                       const Json& settings) {
  Json made_by{{"gramloom", version()}};
  made_by.update(settings);
  const Metadata metadata{
      {"gramloom:settings", made_by.dump(-1, ' ', true, Json::error_handler_t::replace)}};

  std::vector<std::string> files{name + formats.picture.extension};
  write_image(folder / files.front(), texture.image, formats.picture.encoding, metadata);
  for (const auto& [map_name, map] : texture.maps) {
    const OutputFormat& format = formats.maps.at(map_name);
    files.push_back(fmt::format("{}_{}{}", name, map_name, format.extension));
    write_image(folder / files.back(), map, format.encoding, metadata);
  }
  return files;
}

void write_exemplar(const fs::path& folder, const Exemplar& exemplar,
                    const std::vector<ExemplarFile>& files) {
  const Texture parts = split_layers({exemplar.image}, files);
  for (const ExemplarFile& file : files) {
    const bool picture = file.map.empty();
    const std::string name = picture ? "exemplar" : "exemplar_" + file.map;
    const OutputFormat format = output_format(Config(), file.encoding, file.channels);
    write_image(folder / (name + format.extension), picture ? parts.image : parts.maps.at(file.map),
                format.encoding);
    for (const std::string extension : {".png", ".exr", ".tif"})
      if (extension != format.extension) remove_file(folder / (name + extension));
  }
}

}  // namespace gramloom
