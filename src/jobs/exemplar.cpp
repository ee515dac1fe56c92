#include "jobs/exemplar.h"

#include "signal/resize.h"
#include "surface/normal_map.h"

namespace gramloom {

namespace {

bool has_alpha(const ExemplarFile& file) {
  const std::vector<std::string>& names = file.encoding.channel_names;
  const bool seen_together = file.kind == MapKind::colour || file.kind == MapKind::normal;
  return seen_together && file.channels > 1 &&
         ((!names.empty() && names.back() == "A") ||
          (file.kind == MapKind::normal && file.channels == 4));
}

}  // namespace

void shrink(Exemplar& exemplar, int max_side) {
  const Size whole = exemplar.image.size();
  // Each channel is scaled by itself: joined or not, it comes out the same.
  exemplar.image = fit_longer_side(exemplar.image, max_side);
  if (exemplar.image.size() == whole) return;
  for (const Layer& layer : exemplar.layers)
    if (layer.kind == MapKind::normal) make_unit(exemplar.image, layer.first);
  if (!exemplar.mask.empty()) {
    exemplar.mask = resize(exemplar.mask, exemplar.image.size());
    for (float& value : exemplar.mask.pixels) value = value > 0.999f ? 1.0f : 0.0f;
  }
  if (!exemplar.guide.empty()) exemplar.guide = resize(exemplar.guide, exemplar.image.size());
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
