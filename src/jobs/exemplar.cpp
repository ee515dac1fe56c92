#include "jobs/exemplar.h"

#include <algorithm>

#include "io/resize.h"

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
    exemplar.image = join(exemplar.image, map.image);
    exemplar.layers.push_back({name, map.image.channels, std::move(map.encoding)});
  }
  // Each channel is scaled by itself: joined or not, it comes out the same.
  if (entry.max_side) exemplar.image = fit_longer_side(exemplar.image, *entry.max_side);
  return exemplar;
}

int channels_of(const std::vector<Layer>& layers) {
  int channels = 0;
  for (const Layer& layer : layers) channels += layer.channels;
  return channels;
}

Image picture_of(const Exemplar& exemplar) {
  return extract_channels(exemplar.image, 0, exemplar.layers.at(0).channels);
}

Texture split_layers(Texture texture, const std::vector<Layer>& layers) {
  if (layers.size() < 2) return texture;
  int first = 0;
  const auto next = [&](const Layer& layer) {
    Image image = extract_channels(texture.image, first, layer.channels);
    first += layer.channels;
    return image;
  };
  Image picture = next(layers.front());
  for (auto layer = layers.begin() + 1; layer != layers.end(); ++layer)
    texture.maps[layer->map] = next(*layer);
  texture.image = std::move(picture);
  return texture;
}

}  // namespace gramloom
