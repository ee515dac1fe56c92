#include "jobs/exemplar.h"

#include <algorithm>
#include <cmath>

#include "signal/resize.h"
#include "surface/normal_map.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

void check_size(const ExemplarEntry& entry, const Image& picture, const fs::path& file,
                const Image& map) {
  if (map.size() == picture.size()) return;
  throw ConfigError("{}: the map {} has {}×{} pixels and its picture {} {}×{}: they must be equal",
                    entry.place, file.string(), map.width, map.height, entry.image.string(),
                    picture.width, picture.height);
}

// Brings a map whose values leave 0 to 1 there; `file` says from where. By a power of two, so that
// whole numbers come back exactly.
void fit_into_unit_range(Image& map, ExemplarFile& file) {
  const auto [least, most] = std::minmax_element(map.pixels.begin(), map.pixels.end());
  const float low = *least;
  const float high = *most;
  if (low >= 0 && high <= 1) return;
  file.low = low;
  const float range = high > low ? high - low : 1;              // a flat map has none of its own
  const float step = std::max(1.0f, std::abs(low)) * 0x1p-20f;  // that the sum can show
  file.high = low + std::exp2(std::ceil(std::log2(std::max(range, step))));
  for (float& value : map.pixels) value = (value - file.low) / (file.high - file.low);
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

// `image` with the channels of `more` (of its size) after its own.
Image join(const Image& image, const Image& more) {
  Image joined(image.size(), image.channels + more.channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float* after = std::copy_n(image.at(x, y), image.channels, joined.at(x, y));
      std::copy_n(more.at(x, y), more.channels, after);
    }
  return joined;
}

// Normals are in [-1, 1], whatever values a map happens to have of these.
void fit_normals(Image& map, ExemplarFile& file) {
  if (std::none_of(map.pixels.begin(), map.pixels.end(), [](float v) { return v < 0; })) return;
  file.low = -1;
  for (float& value : map.pixels) value = (value + 1) / 2;
}

void check_channels(const ExemplarEntry& entry, const MapFile& map, const ExemplarFile& file) {
  if (file.kind != MapKind::normal || file.channels >= 3) return;
  throw ConfigError("{}: the map {} has {} channels: kind = \"normal\" needs 3", entry.place,
                    map.image.string(), file.channels);
}

bool has_alpha(const ExemplarFile& file) {
  const std::vector<std::string>& names = file.encoding.channel_names;
  const bool seen_together = file.kind == MapKind::colour || file.kind == MapKind::normal;
  return seen_together && file.channels > 1 &&
         ((!names.empty() && names.back() == "A") ||
          (file.kind == MapKind::normal && file.channels == 4));
}

}  // namespace

LoadedExemplar load_exemplar(const ExemplarEntry& entry) {
  ImageFile picture = read_image(entry.image);
  LoadedExemplar loaded{{std::move(picture.image)}, {}, {}};
  const auto keep_notes = [&](const fs::path& path, const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      loaded.notes.push_back(fmt::format("{}: {}", path.filename().string(), note));
  };
  keep_notes(entry.image, picture.notes);
  Image& image = loaded.exemplar.image;
  loaded.files.push_back({"", image.channels, std::move(picture.encoding)});
  for (const auto& [name, entry_of_map] : entry.maps) {
    ImageFile map = read_image(entry_of_map.image);
    const fs::path& path = entry_of_map.image;
    check_size(entry, image, path, map.image);
    keep_notes(path, map.notes);
    note_missing_data(map.image, path.filename().string(), loaded.notes);
    ExemplarFile file{name, map.image.channels, std::move(map.encoding)};
    file.green = green_of_map(name, entry_of_map, map.metadata);
    file.kind = kind_of_map(name, entry_of_map, map.image);
    check_channels(entry, entry_of_map, file);
    file.kind == MapKind::normal ? fit_normals(map.image, file)
                                 : fit_into_unit_range(map.image, file);
    image = join(image, map.image);
    loaded.files.push_back(std::move(file));
  }
  // Each channel is scaled by itself: joined or not, it comes out the same.
  const Size whole = image.size();
  if (entry.max_side) image = fit_longer_side(image, *entry.max_side);
  loaded.exemplar.layers = layers_of(loaded.files);
  if (image.size() != whole)
    for (const Layer& layer : loaded.exemplar.layers)
      if (layer.kind == MapKind::normal) make_unit(image, layer.first);
  return loaded;
}

std::vector<Layer> layers_of(const std::vector<ExemplarFile>& files) {
  std::vector<Layer> layers;
  int first = 0;
  const auto add = [&](const ExemplarFile& file, MapKind kind, int count) {
    if (count > 0) layers.push_back({file.map, kind, first, count, file.green});
    first += std::max(0, count);
  };
  for (const ExemplarFile& file : files) {
    const int alpha = has_alpha(file) ? 1 : 0;
    add(file, file.kind, file.channels - alpha);
    add(file, MapKind::alpha, alpha);
  }
  return layers;
}

int channels_of(const std::vector<ExemplarFile>& files) {
  int channels = 0;
  for (const ExemplarFile& file : files) channels += file.channels;
  return channels;
}

Image picture_of(const Exemplar& exemplar) {
  int channels = 0;
  for (const Layer& layer : exemplar.layers)
    if (layer.name.empty()) channels += layer.count;
  return extract_channels(exemplar.image, 0, channels);
}

Texture split_layers(Texture texture, const std::vector<ExemplarFile>& files) {
  if (files.size() < 2) return texture;
  int first = 0;
  const auto next = [&](const ExemplarFile& file) {
    Image image = extract_channels(texture.image, first, file.channels);
    first += file.channels;
    if (file.low != 0 || file.high != 1)
      for (float& value : image.pixels) value = file.low + value * (file.high - file.low);
    return image;
  };
  Image picture = next(files.front());
  for (auto file = files.begin() + 1; file != files.end(); ++file)
    texture.maps[file->map] = next(*file);
  texture.image = std::move(picture);
  return texture;
}

}  // namespace gramloom
