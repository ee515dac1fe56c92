#include "jobs/arrangement.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "io/image_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* key = "gramloom:coordinates";  // "256x256 300x200"
constexpr int most_integer = 65535;

std::string sizes_to_text(const std::vector<Size>& pictures) {
  std::string text;
  for (const Size size : pictures)
    text += fmt::format("{}{}x{}", text.empty() ? "" : " ", size.width, size.height);
  return text;
}

// None of a text that is no list of sizes.
std::vector<Size> from_text(const std::string& text) {
  std::vector<Size> pictures;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&](int& value) {
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value < 1) return false;
    at = next;
    return true;
  };
  while (at != end) {
    Size size;
    if (!number(size.width) || at == end || *at++ != 'x' || !number(size.height)) return {};
    pictures.push_back(size);
    if (at != end && *at++ != ' ') return {};
  }
  return pictures;
}

}  // namespace

Arrangement arrangement_of(const SourceMap& source, const Request& request,
                           const std::optional<Corner>& filled_at) {
  Arrangement arrangement{source, {}};
  for (const Exemplar& exemplar : request.exemplars)
    arrangement.pictures.push_back(exemplar.image.size());
  const Image& mask = request.target.mask;
  if (mask.empty()) return arrangement;
  const Corner corner = filled_at.value_or(Corner{});
  const int known = filled_at ? 0 : static_cast<int>(arrangement.pictures.size());
  if (!filled_at) arrangement.pictures.push_back(request.target.size);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (*mask.at(x, y) <= 0.5f)
        *arrangement.source.at(x, y) = {x - corner.left, y - corner.top, known};
  return arrangement;
}

std::string write_arrangement(const fs::path& folder, const std::string& name,
                              const Arrangement& arrangement) {
  const SourceMap& source = arrangement.source;
  bool integers = true;
  for (const Size size : arrangement.pictures)
    integers = integers && std::max(size.width, size.height) <= most_integer;
  const float unit = integers ? most_integer : 1;
  Image image(source.size, 3);
  for (std::size_t p = 0; p < source.pixels.size(); ++p) {
    const Source& from = source.pixels[p];
    float* to = image.pixels.data() + 3 * p;
    to[0] = static_cast<float>(from.x) / unit;
    to[1] = static_cast<float>(from.y) / unit;
    to[2] = static_cast<float>(from.exemplar) / unit;
  }
  const std::string file = name + "_coordinates.tif";
  write_image(folder / file, image,
              {integers ? PixelType::uint16 : PixelType::float32, "", {"x", "y", "picture"}},
              {{key, sizes_to_text(arrangement.pictures)}});
  return file;
}

Arrangement read_arrangement(const fs::path& file) {
  const ImageFile read = read_image(file);
  const auto sizes = read.metadata.find(key);
  Arrangement arrangement;
  if (sizes != read.metadata.end()) arrangement.pictures = from_text(sizes->second);
  if (arrangement.pictures.empty() || read.image.channels != 3)
    throw Error(
        "{}: these are no coordinates of gramloom's (coordinates = true in a config writes "
        "them)",
        file.string());
  arrangement.source = SourceMap(read.image.size());
  const float unit = read.encoding.pixel_type == PixelType::uint16 ? most_integer : 1;
  for (std::size_t p = 0; p < arrangement.source.pixels.size(); ++p) {
    const auto value = [&](std::size_t c) {
      return static_cast<long>(std::lround(read.image.pixels[3 * p + c] * unit));
    };
    const long picture = value(2);
    const bool known = picture >= 0 && picture < static_cast<long>(arrangement.pictures.size());
    const Size size = known ? arrangement.pictures[static_cast<std::size_t>(picture)] : Size{};
    if (value(0) < 0 || value(0) >= size.width || value(1) < 0 || value(1) >= size.height)
      throw Error("{}: ({}, {}) of picture {} is not there: the file was changed", file.string(),
                  value(0), value(1), picture + 1);
    arrangement.source.pixels[p] = {static_cast<int>(value(0)), static_cast<int>(value(1)),
                                    static_cast<int>(picture)};
  }
  return arrangement;
}

}  // namespace gramloom
