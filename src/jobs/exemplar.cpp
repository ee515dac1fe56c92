#include "jobs/exemplar.h"

#include <algorithm>
#include <cmath>

#include "signal/resize.h"

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

// Brings a map whose values leave 0 to 1 there; the layer says from where.
void fit_into_unit_range(Image& map, ExemplarLayer& layer) {
  const auto [least, most] = std::minmax_element(map.pixels.begin(), map.pixels.end());
  const float low = *least;
  const float high = *most;
  if (low >= 0 && high <= 1) return;
  layer.low = low;
  layer.high = high > low
                   ? high
                   : low + std::max(1.0f, std::abs(low));  // a flat map has no range of its own
  for (float& value : map.pixels) value = (value - layer.low) / (layer.high - layer.low);
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

}  // namespace

Exemplar load_exemplar(const ExemplarEntry& entry) {
  ImageFile picture = read_image(entry.image);
  Exemplar exemplar{std::move(picture.image), {}};
  exemplar.layers.push_back({"", exemplar.image.channels, std::move(picture.encoding)});
  for (const auto& [name, file] : entry.maps) {
    ImageFile map = read_image(file);
    check_size(entry, exemplar.image, file, map.image);
    ExemplarLayer layer{name, map.image.channels, std::move(map.encoding)};
    fit_into_unit_range(map.image, layer);
    exemplar.image = join(exemplar.image, map.image);
    exemplar.layers.push_back(std::move(layer));
  }
  // Each channel is scaled by itself: joined or not, it comes out the same.
  if (entry.max_side) exemplar.image = fit_longer_side(exemplar.image, *entry.max_side);
  return exemplar;
}

int channels_of(const std::vector<ExemplarLayer>& layers) {
  int channels = 0;
  for (const ExemplarLayer& layer : layers) channels += layer.channels;
  return channels;
}

Image picture_of(const Exemplar& exemplar) {
  return extract_channels(exemplar.image, 0, exemplar.layers.at(0).channels);
}

Texture split_layers(Texture texture, const std::vector<ExemplarLayer>& layers) {
  if (layers.size() < 2) return texture;
  int first = 0;
  const auto next = [&](const ExemplarLayer& layer) {
    Image image = extract_channels(texture.image, first, layer.channels);
    first += layer.channels;
    if (layer.low != 0 || layer.high != 1)
      for (float& value : image.pixels) value = layer.low + value * (layer.high - layer.low);
    return image;
  };
  Image picture = next(layers.front());
  for (auto layer = layers.begin() + 1; layer != layers.end(); ++layer)
    texture.maps[layer->map] = next(*layer);
  texture.image = std::move(picture);
  return texture;
}

}  // namespace gramloom
