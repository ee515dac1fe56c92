#include <gtest/gtest.h>

#include <cmath>

#include "classic/phase.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

struct Moments {
  double mean = 0, deviation = 0, beside = 0;  // beside: correlation of horizontal neighbours
};

Moments moments(const Image& image, int left, int right) {
  Moments m;
  double n = 0, squares = 0, products = 0, pairs = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) {
      m.mean += double{*image.at(x, y)};
      n += 1;
    }
  m.mean /= n;
  for (int y = 0; y < image.height; ++y)
    for (int x = left; x < right; ++x) {
      const double d = double{*image.at(x, y)} - m.mean;
      squares += d * d;
      if (x + 1 == right) continue;
      products += d * (double{*image.at(x + 1, y)} - m.mean);
      pairs += 1;
    }
  m.deviation = std::sqrt(squares / n);
  m.beside = products / pairs / (squares / n);
  return m;
}

/// Blobs, as contrasting as asked.
Image cloudy(Size size, float mean, float contrast, std::uint64_t seed) {
  Image image = blobs(size.width, size.height, 1, seed);
  for (float& v : image.pixels) v = mean + contrast * (v - 0.5f);
  return image;
}

Image phase(const Request& request) { return synthesise(PhaseParams{}, request, {}).image; }

TEST(DirectedPhase, MaskedPixelsDoNotCount) {
  Image picture = cloudy({96, 80}, 0.5f, 2, 1);
  const Image mask = rectangle({96, 80}, 30, 20, 30, 40, 0);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    if (mask.pixels[i] < 0.5f) picture.pixels[i] = 50;
  for (const Size size : {Size{128, 128}, Size{64, 64}, Size{96, 80}}) {
    const Image image = phase({{{picture, {}, mask}}, {size, Tile::both}, Random(1)});
    const Moments is = moments(image, 0, size.width);
    const Moments wanted = moments(cloudy({96, 80}, 0.5f, 2, 1), 0, 96);
    EXPECT_NEAR(is.mean, wanted.mean, 0.02);
    EXPECT_NEAR(is.deviation, wanted.deviation, 0.25 * wanted.deviation);
    EXPECT_NEAR(is.beside, wanted.beside, 0.08);
  }
}

TEST(DirectedPhase, SeveralAreMixedByTheirWeights) {
  const Image calm = cloudy({80, 64}, 0.3f, 0.5f, 1), rough = cloudy({64, 96}, 0.7f, 3, 2);
  Request request{{{calm}, {rough}}, {{200, 100}, Tile::both}, Random(2)};
  request.target.weights = Image({200, 100}, 2);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 200; ++x) request.target.weights.at(x, y)[x < 100 ? 0 : 1] = 2;
  const Image mixed = phase(request);
  EXPECT_NEAR(moments(mixed, 0, 100).mean, 0.3, 0.02);
  EXPECT_NEAR(moments(mixed, 100, 200).mean, 0.7, 0.06);
  const double of_calm = moments(calm, 0, 80).deviation, of_rough = moments(rough, 0, 64).deviation;
  EXPECT_NEAR(moments(mixed, 0, 100).deviation, of_calm, 0.3 * of_calm);
  EXPECT_NEAR(moments(mixed, 100, 200).deviation, of_rough, 0.3 * of_rough);
  request.target.weights = {};
  // By their pixels: 5120 and 6144.
  EXPECT_NEAR(moments(phase(request), 0, 200).mean, 0.3 * 5 / 11 + 0.7 * 6 / 11, 0.05);
  const int before = thread_count();
  set_thread_count(1);
  const Image one = phase(request);
  set_thread_count(5);
  EXPECT_EQ(one, phase(request));
  set_thread_count(before);
}

}  // namespace
}  // namespace gramloom
