#include "jobs/picture_files.h"

#include <algorithm>
#include <cmath>

#include "io/without_alpha.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

void check_size(const PictureFiles& picture, const fs::path& file, const Image& map,
                const std::string& place) {
  const Image& image = picture.images.front();
  if (map.size() == image.size()) return;
  throw ConfigError("{}: the map {} has {}×{} pixels and its picture {} {}×{}: they must be equal",
                    place, file.string(), map.width, map.height, picture.file.string(), image.width,
                    image.height);
}

// Programs for maps of terrain mark missing data by a number far below all others.
void note_missing_data(const Image& map, const std::string& file, std::vector<std::string>& notes) {
  for (const float mark : {-9999.0f, -99999.0f, -32768.0f, -32767.0f})
    if (const auto count = std::count(map.pixels.begin(), map.pixels.end(), mark);
        count > 0 && *std::min_element(map.pixels.begin(), map.pixels.end()) == mark)
      notes.push_back(fmt::format(
          "{}: {:.3g} % of the values are {}, taken as a number like all others; if it marks "
          "missing data, fill such places first",
          file, 100.0 * static_cast<double>(count) / static_cast<double>(map.pixels.size()), mark));
}

void check_channels(const MapFile& map, const ExemplarFile& file, const std::string& place) {
  if (file.kind != MapKind::normal || file.channels >= 3) return;
  throw ConfigError("{}: the map {} has {} channels: kind = \"normal\" needs 3", place,
                    map.image.string(), file.channels);
}

// The range of whole powers of two, so that whole numbers come back exactly, about all values of a
// map; `file` says from where they were brought to 0 to 1.
void set_range(float low, float high, ExemplarFile& file) {
  if (file.kind == MapKind::normal) {
    if (low < 0) file.low = -1;  // normals are in [-1, 1], whatever values of these there are
    return;
  }
  if (low >= 0 && high <= 1) return;
  file.low = low;
  const float range = high > low ? high - low : 1;              // a flat map has none of its own
  const float step = std::max(1.0f, std::abs(low)) * 0x1p-20f;  // that the sum can show
  file.high = low + std::exp2(std::ceil(std::log2(std::max(range, step))));
}

void bring_to_range(Image& map, const ExemplarFile& file) {
  if (file.low == 0 && file.high == 1) return;
  if (file.kind == MapKind::normal)
    for (float& value : map.pixels) value = (value + 1) / 2;
  else
    for (float& value : map.pixels) value = (value - file.low) / (file.high - file.low);
}

std::string name_of(const ExemplarFile& file) {
  return file.map.empty() ? "the picture" : fmt::format("the map '{}'", file.map);
}

void check_alike(const PictureFiles& first, const PictureFiles& other, const std::string& place) {
  if (first.files.size() != other.files.size())
    throw ConfigError("{}: {} has {} maps and {} {}: they are of one material", place,
                      first.file.string(), first.files.size() - 1, other.file.string(),
                      other.files.size() - 1);
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    const ExemplarFile& a = first.files[i];
    const ExemplarFile& b = other.files[i];
    if (a.map != b.map)
      throw ConfigError("{}: {} has {} where {} has {}: they are of one material", place,
                        first.file.string(), name_of(a), other.file.string(), name_of(b));
    if (a.channels != b.channels)
      throw ConfigError("{}: {} of {} has {} channels, and of {} {}: they must be equal", place,
                        name_of(a), first.file.string(), a.channels, other.file.string(),
                        b.channels);
    if (a.kind != b.kind || a.green != b.green)
      throw ConfigError("{}: {} is of another kind for {} than for {}: say kind and green", place,
                        name_of(a), first.file.string(), other.file.string());
  }
}

}  // namespace

PictureFiles read_picture(const ExemplarPicture& entry, const std::string& place) {
  PictureFiles picture;
  picture.file = entry.image;
  const auto keep_notes = [&](const fs::path& path, const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      picture.notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
  };
  ImageFile image = read_image(entry.image);
  keep_notes(entry.image, image.notes);
  picture.metadata = std::move(image.metadata);
  picture.files.push_back({"", image.image.channels, std::move(image.encoding)});
  picture.images.push_back(std::move(image.image));
  for (const auto& [name, entry_of_map] : entry.maps) {
    const fs::path& path = entry_of_map.image;
    ImageFile map = read_image(path);
    check_size(picture, path, map.image, place);
    keep_notes(path, map.notes);
    note_missing_data(map.image, path.filename().string(), picture.notes);
    ExemplarFile file{name, map.image.channels, std::move(map.encoding)};
    file.green = green_of_map(name, entry_of_map, map.metadata);
    file.kind = kind_of_map(name, entry_of_map, map.image);
    check_channels(entry_of_map, file, place);
    picture.files.push_back(std::move(file));
    picture.images.push_back(std::move(map.image));
  }
  return picture;
}

void fit_together(std::vector<PictureFiles>& pictures, const std::string& place) {
  PictureFiles& first = pictures.front();
  for (const PictureFiles& picture : pictures) check_alike(first, picture, place);
  for (std::size_t map = 1; map < first.files.size(); ++map) {
    float low = first.images[map].pixels.front();
    float high = low;
    for (const PictureFiles& picture : pictures) {
      const auto [least, most] = std::ranges::minmax(picture.images[map].pixels);
      low = std::min(low, least);
      high = std::max(high, most);
    }
    for (PictureFiles& picture : pictures) {
      set_range(low, high, picture.files[map]);
      bring_to_range(picture.images[map], picture.files[map]);
    }
  }
}

Image joined(PictureFiles picture) {
  if (picture.images.size() == 1) return std::move(picture.images.front());
  Image image(picture.images.front().size(), channels_of(picture.files));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float* to = image.at(x, y);
      for (const Image& part : picture.images) to = std::copy_n(part.at(x, y), part.channels, to);
    }
  return image;
}

Image brightness(ImageFile file) {
  const Image picture = without_alpha(std::move(file));
  Image result(picture.size(), 1);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      float sum = 0;
      for (int c = 0; c < picture.channels; ++c) sum += picture.at(x, y)[c];
      *result.at(x, y) = sum / static_cast<float>(picture.channels);
    }
  return result;
}

ImageFile read_sized(const fs::path& file, Size size, const std::string& what,
                     const std::string& of, const std::string& place) {
  ImageFile read = read_image(file);
  const Image& image = read.image;
  if (image.size() == size) return read;
  throw ConfigError("{}: {} {} has {}×{} pixels and {} {}×{}: they must be equal", place, what,
                    file.string(), image.width, image.height, of, size.width, size.height);
}

Image read_mask(const FileOrName& mask, const PictureFiles& picture, const std::string& what,
                const std::string& place) {
  const Image& image = picture.images.front();
  Image result;
  if (mask.is_name()) {
    const std::vector<Layer> layers = layers_of({picture.files.front()});
    if (layers.back().kind != MapKind::alpha)
      throw ConfigError("{}: {} is \"alpha\", and {} has none", place, what, picture.file.string());
    result = extract_channels(image, image.channels - 1, 1);
  } else {
    result = brightness(read_sized(mask, image.size(), what, picture.file.string(), place));
  }
  for (float& value : result.pixels) value = value > 0.5f ? 1.0f : 0.0f;
  return result;
}

}  // namespace gramloom
