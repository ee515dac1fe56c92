#include "neural/guidance.h"

#include <algorithm>

#include "neural/picture.h"
#include "neural/resample.h"
#include "signal/resize.h"

namespace gramloom::neural {

namespace {

// `image`, of the target's size or of 1×1, on the canvas: what lies beyond its edges is that of the
// nearest pixel.
Image on_canvas(const Image& image, Size size, Size canvas) {
  const int left = (canvas.width - size.width) / 2, top = (canvas.height - size.height) / 2;
  Image result(canvas, image.channels);
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      std::copy_n(map_at(image, std::clamp(x - left, 0, size.width - 1),
                         std::clamp(y - top, 0, size.height - 1)),
                  image.channels, result.at(x, y));
  return result;
}

bool is_all(const Image& mask) {
  return std::ranges::all_of(mask.pixels, [](float v) { return v > 0.5f; });
}

// 0 for 1, and the reverse.
Image inverted(Image mask) {
  for (float& value : mask.pixels) value = value > 0.5f ? 0.0f : 1.0f;
  return mask;
}

// Calls f(value) for the mask's pixels under pixel (x, y) of a smaller size.
template <class F>
void for_each_under(const Image& mask, Size size, int x, int y, F&& f) {
  const auto begin = [](std::int64_t at, int from, int to) {
    return static_cast<int>(at * from / to);
  };
  const auto end = [](std::int64_t at, int from, int to) {
    return static_cast<int>((at * from + to - 1) / to);
  };
  for (int v = begin(y, mask.height, size.height); v < end(y + 1, mask.height, size.height); ++v)
    for (int u = begin(x, mask.width, size.width); u < end(x + 1, mask.width, size.width); ++u)
      f(*mask.at(u, v));
}

}  // namespace

std::optional<Guidance> guidance_of(const Request& request, const United& united, Size canvas,
                                    const ColourPca& colours) {
  const Target& target = request.target;
  const Exemplar& exemplar = united.exemplar();
  Guidance g;
  g.tile = target.tile;
  g.whole = request.exemplars.size() == 1;
  g.channels = exemplar.image.channels;
  if (!is_all(exemplar.mask)) g.usable = exemplar.mask;
  const int own = target.guide.channels, mixed = exemplar.guide.channels - own;
  if (mixed > 0) {
    g.member = extract_channels(exemplar.guide, own, mixed);
    g.shares = on_canvas(extract_channels(united.guide(), own, mixed), target.size, canvas);
  }
  if (own > 0) {
    g.exemplar_guide = extract_channels(exemplar.guide, 0, own);
    g.guide = on_canvas(target.guide, target.size, canvas);
    g.guide_weight =
        on_canvas(target.guide_weight.empty() ? Image(1, 1, 1, 1.0f) : target.guide_weight,
                  target.size, canvas);
  }
  if (!target.mask.empty() && !is_all(target.mask)) {
    const Image stays = inverted(target.mask);
    g.made = inverted(stays);
    g.known = to_planes(extended(whitened(target.known, colours), stays));
  }
  if (g.usable.empty() && !g.directs()) return std::nullopt;
  return g;
}

Guidance scaled(const Guidance& finest, Size exemplar, Size result) {
  Guidance g;
  g.tile = finest.tile;
  g.whole = finest.whole;
  g.channels = finest.channels;
  if (!finest.usable.empty()) g.usable = scaled_mask(finest.usable, exemplar);
  if (finest.mixes()) {
    g.member = resize(finest.member, exemplar);
    g.shares = resize(finest.shares, result);
  }
  if (finest.guides()) {
    g.exemplar_guide = resize(finest.exemplar_guide, exemplar);
    g.guide = resize(finest.guide, result);
    g.guide_weight = resize(finest.guide_weight, result);
  }
  if (finest.fills()) {
    g.made = inverted(scaled_mask(inverted(finest.made), result));
    g.known = resample(finest.known, result, finest.tile);
  }
  return g;
}

Guidance with_shares_as_guide(Guidance guidance) {
  if (!guidance.mixes()) return guidance;
  const auto joined = [](const Image& guide, const Image& shares) {
    Image result(shares.size(), guide.channels + shares.channels);
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x) {
        float* to = result.at(x, y);
        if (!guide.empty()) to = std::copy_n(guide.at(x, y), guide.channels, to);
        std::copy_n(shares.at(x, y), shares.channels, to);
      }
    return result;
  };
  if (!guidance.guides()) guidance.guide_weight = Image(guidance.shares.size(), 1, 1.0f);
  guidance.guide = joined(guidance.guide, guidance.shares);
  guidance.exemplar_guide = joined(guidance.exemplar_guide, guidance.member);
  return guidance;
}

Image scaled_mask(const Image& mask, Size size) {
  Image result(size, 1, 1.0f);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for_each_under(mask, size, x, y, [&](float value) {
        if (value <= 0.5f) *result.at(x, y) = 0;
      });
  return result;
}

void keep_known(const Guidance& guidance, at::Tensor& picture, double factor) {
  const float* made = guidance.made.pixels.data();
  const auto pixels = static_cast<std::int64_t>(guidance.made.pixels.size());
  picture = picture.contiguous();
  const at::Tensor known = guidance.known.contiguous();
  for (std::int64_t c = 0; c < picture.size(0); ++c) {
    float* to = picture.data_ptr<float>() + c * pixels;
    const float* from = known.data_ptr<float>() + c * pixels;
    for (std::int64_t i = 0; i < pixels; ++i)
      if (made[i] <= 0) to[i] = from[i] * static_cast<float>(factor);
  }
}

Image usable_pixels(const Image& image, const Image& mask) {
  if (mask.empty()) return image;
  std::vector<float> pixels;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (*mask.at(x, y) > 0.5f)
        pixels.insert(pixels.end(), image.at(x, y), image.at(x, y) + image.channels);
  Image row;
  row.width = static_cast<int>(pixels.size() / static_cast<std::size_t>(image.channels));
  row.height = 1;
  row.channels = image.channels;
  row.pixels = std::move(pixels);
  return row;
}

std::vector<int> steps_to_known(const Image& made) {
  const int far = made.width + made.height;
  std::vector<int> steps(made.pixels.size());
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = made.pixels[i] > 0 ? far : 0;
  const auto look = [&](int x, int y, int dx, int dy) {
    if (x + dx < 0 || x + dx >= made.width || y + dy < 0 || y + dy >= made.height) return;
    int& own = steps[made.index(x, y)];
    own = std::min(own, steps[made.index(x + dx, y + dy)] + 1);
  };
  // From the upper left, then from the lower right (Rosenfeld, Pfaltz 1966).
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x) {
      look(x, y, -1, 0);
      for (int dx = -1; dx <= 1; ++dx) look(x, y, dx, -1);
    }
  for (int y = made.height - 1; y >= 0; --y)
    for (int x = made.width - 1; x >= 0; --x) {
      look(x, y, 1, 0);
      for (int dx = -1; dx <= 1; ++dx) look(x, y, dx, 1);
    }
  return steps;
}

}  // namespace gramloom::neural
