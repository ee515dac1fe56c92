#include "jobs/texture_rows.h"

#include <utility>

namespace gramloom {

TextureRows::TextureRows(std::filesystem::path folder, std::string name, Size size,
                         const OutputFormats& formats, const Json& settings,
                         const Metadata& picture)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      size_(size),
      formats_(formats),
      settings_(settings),
      picture_(picture) {}

void TextureRows::open(const Texture& first) {
  const auto begin = [&](const std::string& map, const Image& rows, const OutputFormat& format) {
    const std::string file = file_of_texture(name_, map, format);
    files_[map] = {
        file, format,
        open_image_rows(folder_ / file, size_, rows.channels, format.encoding,
                        texture_metadata(format, settings_, map.empty() ? picture_ : Metadata()))};
  };
  begin("", first.image, formats_.picture);
  for (const auto& [map, rows] : first.maps) begin(map, rows, formats_.maps.at(map));
}

void TextureRows::write(const Texture& rows) {
  if (files_.empty()) open(rows);
  for (auto& [map, file] : files_) {
    const Image some = scaled(map.empty() ? rows.image : rows.maps.at(map), file.format);
    file.rows->write(some.pixels.data(), some.height);
  }
}

WrittenTexture TextureRows::finish() {
  WrittenTexture written;
  for (auto& [map, file] : files_) {
    written.files.push_back(file.name);
    add_notes(written, file.name, file.format, file.rows->finish());
  }
  return written;
}

}  // namespace gramloom
