#include "surface/tiling_values.h"

#include <algorithm>
#include <cmath>

#include "core/portable_math.h"
#include "core/threads.h"
#include "signal/sort.h"
#include "signal/united.h"

namespace gramloom {

namespace {

constexpr int table_size = 4096;
constexpr float least_z = 0.05f;          // of a normal: steeper slopes count as this
constexpr float prominence_share = 0.6f;  // of a weight

std::vector<Layer> layers_of(const Exemplar& exemplar) {
  if (!exemplar.layers.empty()) return exemplar.layers;
  return {{"", MapKind::colour, 0, exemplar.image.channels}};
}

float lookup(const std::vector<float>& table, float position) {
  const auto last = static_cast<int>(table.size()) - 1;
  const float inside = std::clamp(position, 0.0f, static_cast<float>(last));
  const int below = std::min(static_cast<int>(inside), last - 1);
  const float share = inside - static_cast<float>(below);
  const float* at = table.data() + below;
  return at[0] + share * (at[1] - at[0]);
}

// Ascending values and the normal values that stand for them.
struct Ranks {
  std::vector<float> normal, value;
};

// Samples of the function from normal values to values, evenly spaced.
std::vector<float> sample(const Ranks& ranks) {
  const float low = ranks.normal.front(), high = ranks.normal.back();
  std::vector<float> table(table_size);
  std::size_t next = 1;
  for (int i = 0; i < table_size; ++i) {
    const float wanted =
        low + (high - low) * (static_cast<float>(i) / static_cast<float>(table_size - 1));
    while (next + 1 < ranks.normal.size() && ranks.normal[next] < wanted) ++next;
    const float before = ranks.normal[next - 1], after = ranks.normal[next];
    const float share = std::clamp((wanted - before) / (after - before), 0.0f, 1.0f);
    table[static_cast<std::size_t>(i)] =
        ranks.value[next - 1] + share * (ranks.value[next] - ranks.value[next - 1]);
  }
  return table;
}

// Those pixels of an image, as one of their number; all: itself.
Image pixels_of(const Image& image, const std::vector<std::size_t>& which) {
  const auto channels = static_cast<std::size_t>(image.channels);
  if (which.size() * channels == image.pixels.size()) return image;
  Image result(static_cast<int>(which.size()), 1, image.channels);
  for (std::size_t i = 0; i < which.size(); ++i)
    std::copy_n(image.pixels.data() + which[i] * channels, channels,
                result.pixels.data() + i * channels);
  return result;
}

Image lightness_of(const Image& image, int channels) {
  Image light(image.size(), 1);
  for (std::size_t i = 0; i < light.pixels.size(); ++i) {
    const float* pixel = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
    float sum = 0;
    for (int c = 0; c < channels; ++c) sum += pixel[c] / static_cast<float>(channels);
    light.pixels[i] = sum;
  }
  return light;
}

// 0.4 where the map is lowest, 1 where it is highest.
Image prominence_of(const Exemplar& exemplar) {
  const auto layers = layers_of(exemplar);
  const auto height =
      std::ranges::find_if(layers, [](const Layer& layer) { return layer.name == "height"; });
  Image map = height != layers.end()
                  ? extract_channels(exemplar.image, height->first, 1)
                  : lightness_of(exemplar.image, std::min(3, layers.front().count));
  const auto [low, high] = std::ranges::minmax(map.pixels);
  const float scale = high > low ? 1 / (high - low) : 0;
  for (float& value : map.pixels)
    value = 1 - prominence_share + prominence_share * (value - low) * scale;
  return map;
}

}  // namespace

TilingValues::TilingValues(const Exemplar& whole, TileBlend blend)
    : blend_(blend), slopes_(static_cast<std::size_t>(whole.image.channels)) {
  const std::size_t pixels =
      static_cast<std::size_t>(whole.image.width) * static_cast<std::size_t>(whole.image.height);
  for (std::size_t i = 0; i < pixels; ++i)
    if (whole.mask.empty() || whole.mask.pixels[i] > 0.5f) usable_.push_back(i);
  // Masked pixels have values that don't widen any range.
  Exemplar masked;
  if (!whole.mask.empty()) masked = {extended(whole.image, whole.mask), whole.layers};
  const Exemplar& exemplar = whole.mask.empty() ? whole : masked;
  values_ = exemplar.image;
  range_ = channel_range(exemplar.image);
  if (blend == TileBlend::contrast) prominence_ = prominence_of(exemplar);
  for (const Layer& layer : layers_of(exemplar)) {
    if (layer.kind == MapKind::normal)
      parts_.push_back(take_normals(exemplar.image, layer));
    else if (blend == TileBlend::contrast)
      parts_.push_back({layer, {}, {}, {}, {}, {}, {}});
    else if (layer.kind == MapKind::colour)
      parts_.push_back(take_colour(exemplar.image, layer));
    else
      parts_.push_back(take_scalars(layer));
  }
}

TilingValues::Part TilingValues::take_colour(const Image& exemplar, const Layer& layer) {
  const Image colours = extract_channels(exemplar, layer.first, layer.count);
  Part part{layer, colour_pca(pixels_of(colours, usable_)), {}, {}, {}, {}, {}};
  const Image white = whitened(colours, part.axes);
  const auto count = static_cast<std::size_t>(layer.count);
  for (std::size_t i = 0; i < white.pixels.size(); ++i)
    values_.pixels[i / count * static_cast<std::size_t>(values_.channels) +
                   static_cast<std::size_t>(layer.first) + i % count] = white.pixels[i];
  for (int c = 0; c < layer.count; ++c) part.tables.push_back(take_ranks(layer.first + c));
  part.back.resize(count * count);
  for (std::size_t axis = 0; axis < count; ++axis)
    for (std::size_t c = 0; c < count; ++c)
      part.back[c * count + axis] = part.axes.axes[axis * count + c] * part.axes.deviation[axis];
  return part;
}

TilingValues::Part TilingValues::take_scalars(const Layer& layer) {
  Part part{layer, {}, {}, {}, {}, {}, {}};
  for (int c = 0; c < layer.count; ++c) part.tables.push_back(take_ranks(layer.first + c));
  return part;
}

// Replaces a channel of the values by the normal values of their ranks.
TilingValues::Table TilingValues::take_ranks(int channel) {
  const auto channels = static_cast<std::size_t>(values_.channels);
  const std::size_t pixels = usable_.size();
  std::vector<float> plane(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    plane[i] = values_.pixels[usable_[i] * channels + static_cast<std::size_t>(channel)];
  Sorter sorter;
  const auto ranked = sorter.rank(plane);
  Ranks ranks;
  for (std::size_t begin = 0, end = 0; begin < pixels; begin = end) {
    while (end < pixels && ranked[end].value() == ranked[begin].value()) ++end;
    const double middle = static_cast<double>(begin + end) / 2;
    ranks.value.push_back(ranked[begin].value());
    ranks.normal.push_back(
        static_cast<float>(portable::inverse_normal(middle / static_cast<double>(pixels))));
    for (std::size_t i = begin; i < end; ++i)
      values_.pixels[usable_[ranked[i].place] * channels + static_cast<std::size_t>(channel)] =
          ranks.normal.back();
  }
  if (ranks.value.size() == 1) return {0, 0, {ranks.value[0], ranks.value[0]}};
  const float width = ranks.normal.back() - ranks.normal.front();
  return {ranks.normal.front(), (table_size - 1) / width, sample(ranks)};
}

TilingValues::Part TilingValues::take_normals(const Image& exemplar, const Layer& layer) {
  Part part{layer, {}, {}, {}, {0, 0}, {0, 0}, {0, 0}};
  slopes_[static_cast<std::size_t>(layer.first)] = layer.green == GreenAxis::up ? 1.0f : -1.0f;
  std::array<double, 2> sum{};
  const auto for_each_pixel = [&](auto&& work) {
    const auto channels = static_cast<std::size_t>(exemplar.channels);
    for (const std::size_t i : usable_)
      work(exemplar.pixels.data() + i * channels + layer.first,
           values_.pixels.data() + i * channels + layer.first);
  };
  for_each_pixel([&](const float* normal, float* slopes) {
    const float z = std::max(2 * normal[2] - 1, least_z);
    slopes[2] = 0;
    for (std::size_t i : {0u, 1u}) {
      slopes[i] = (2 * normal[i] - 1) / z;
      sum[i] += static_cast<double>(slopes[i]);
      part.least_slopes[i] = std::min(part.least_slopes[i], slopes[i]);
      part.most_slopes[i] = std::max(part.most_slopes[i], slopes[i]);
    }
  });
  const auto pixels = static_cast<double>(usable_.size());
  for (std::size_t i : {0u, 1u}) part.mean_slopes[i] = static_cast<float>(sum[i] / pixels);
  for_each_pixel([&](const float*, float* slopes) {
    for (std::size_t i : {0u, 1u}) slopes[i] -= part.mean_slopes[i];
  });
  return part;
}

void TilingValues::restore_colour(const Part& part, std::span<float> along, float* pixel) {
  const auto count = part.tables.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Table& table = part.tables[i];
    along[i] = lookup(table.values, (pixel[i] - table.low) * table.scale);
  }
  for (std::size_t c = 0; c < count; ++c) {
    float colour = part.axes.mean[c];
    for (std::size_t i = 0; i < count; ++i) colour += part.back[c * count + i] * along[i];
    pixel[c] = colour;
  }
}

void TilingValues::restore_normal(const Part& part, float* pixel) {
  std::array<float, 2> slope{};
  for (std::size_t i : {0u, 1u})
    slope[i] =
        std::clamp(pixel[i] + part.mean_slopes[i], part.least_slopes[i], part.most_slopes[i]);
  const float length = std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + 1);
  pixel[0] = (slope[0] / length + 1) / 2;
  pixel[1] = (slope[1] / length + 1) / 2;
  pixel[2] = (1 / length + 1) / 2;
}

void TilingValues::restore(float* pixels, int count) const {
  const auto channels = static_cast<std::size_t>(values_.channels);
  const std::size_t end = static_cast<std::size_t>(count) * channels;
  for (const Part& part : parts_) {
    const auto first = static_cast<std::size_t>(part.layer.first);
    if (part.layer.kind == MapKind::normal) {
      for (std::size_t i = first; i < end; i += channels) restore_normal(part, pixels + i);
      continue;
    }
    if (!part.axes.mean.empty()) {
      std::vector<float> along(part.tables.size());
      for (std::size_t i = first; i < end; i += channels) restore_colour(part, along, pixels + i);
    } else {
      for (std::size_t c = 0; c < part.tables.size(); ++c) {
        const Table& table = part.tables[c];
        for (std::size_t i = first + c; i < end; i += channels)
          pixels[i] = lookup(table.values, (pixels[i] - table.low) * table.scale);
      }
    }
    const auto last = first + static_cast<std::size_t>(part.layer.count);
    for (std::size_t c = first; c < last; ++c)
      for (std::size_t i = c; i < end; i += channels)
        pixels[i] = std::clamp(pixels[i], range_.low[c], range_.high[c]);
  }
}

}  // namespace gramloom
