#include "surface/stochastic_cover.h"

#include <algorithm>
#include <cmath>

#include "signal/resize.h"
#include "surface/preview_material.h"
#include "surface/stochastic_tiling.h"

namespace gramloom {

namespace {

constexpr double most_values = 1 << 26;

// A material's pictures as channels of one.
class Joined {
 public:
  explicit Joined(const PreviewMaterial& material) : size_(size_of(material)) {
    if (!material.colour.empty())
      add("", MapKind::colour,
          extract_channels(material.colour, 0, material.colour.channels < 3 ? 1 : 3), {});
    for (const auto& [name, map] : material.maps)
      if (name == "normal")
        add(name, MapKind::normal, as_colours(extract_channels(map, 0, 3)), material.green);
      else
        add(name, MapKind::scalar, map, {});
  }

  // One image of all, of another size if need be.
  Exemplar exemplar(Size size) const {
    Exemplar exemplar{Image(size, channels_), layers_};
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const Image part = size == size_ ? parts_[i] : resize(parts_[i], size);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          std::copy_n(part.at(x, y), part.channels, exemplar.image.at(x, y) + layers_[i].first);
    }
    for (const Layer& layer : layers_)
      if (layer.kind == MapKind::normal) make_unit(exemplar.image, layer.first);
    return exemplar;
  }

  Size size() const { return size_; }
  int channels() const { return channels_; }

 private:
  void add(const std::string& name, MapKind kind, Image part, GreenAxis green) {
    layers_.push_back({name, kind, channels_, part.channels, green});
    channels_ += part.channels;
    parts_.push_back(std::move(part));
  }

  Size size_;
  int channels_ = 0;
  std::vector<Image> parts_;
  std::vector<Layer> layers_;
};

Size times(Size size, double x, double y) {
  const auto side = [](int pixels, double by) {
    return std::max(1, static_cast<int>(std::lround(pixels * by)));
  };
  return {side(size.width, x), side(size.height, y)};
}

// So that its cover has no more pixels than are seen.
double reduction(Size cover, int longest) {
  return std::min(1.0, 1.0 * longest / std::max(cover.width, cover.height));
}
// So that it fits into memory.
double loss(Size cover, int channels) {
  return std::min(1.0, std::sqrt(most_values / (1.0 * cover.width * cover.height * channels)));
}

}  // namespace

Cover covered(const PreviewMaterial& material, Vec2 repeats, double rotation, int longest,
              Random random) {
  check_material(material);
  const Joined joined(material);
  if (joined.channels() == 0) return {material};
  const double u = static_cast<double>(repeats.u), v = static_cast<double>(repeats.v);
  const double seen = reduction(times(joined.size(), u, v), longest);
  const double lost = loss(times(joined.size(), u * seen, v * seen), joined.channels());
  const double by = seen * lost;
  const Size small = times(joined.size(), by, by), size = times(small, u, v);
  const Exemplar exemplar = joined.exemplar(small);
  const TilingParams params{.rotation = rotation, .wraps = material.wraps};
  const StochasticTiling tiling(exemplar, params, size, Tile::both, random);
  Image cover(size, joined.channels());
  tiling.rows(0, size.height, size.width, cover.at(0, 0));

  Cover result{{}, lost};
  result.material.green = material.green;
  result.material.wraps = Tile::both;
  for (const Layer& layer : exemplar.layers) {
    Image part = extract_channels(cover, layer.first, layer.count);
    (layer.name.empty() ? result.material.colour : result.material.maps[layer.name]) =
        std::move(part);
  }
  return result;
}

}  // namespace gramloom
