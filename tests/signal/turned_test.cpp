#include "signal/turned.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gramloom {
namespace {

Image ramp(Size size) {
  Image image(size, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) *image.at(x, y) = static_cast<float>(x + 100 * y);
  return image;
}

Request turned_by(const Exemplar& exemplar, float turn, float scale) {
  Request request{{exemplar}, {{16, 16}}};
  request.target.turn = Image(1, 1, 2);
  request.target.turn.pixels = {turn, scale};
  return request;
}

TEST(Turned, AQuarterCounterClockwiseMovesTheRightEdgeUp) {
  const Turned turned(turned_by({ramp({7, 5})}, 0.25f, 0));
  const Exemplar& copy = turned.request().exemplars.at(0);
  ASSERT_EQ(copy.image.size(), (Size{5, 7}));
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 5; ++x) {
      EXPECT_NEAR(*copy.image.at(x, y), 6 - y + 100 * x, 1e-2) << x << ", " << y;
      EXPECT_EQ(*copy.mask.at(x, y), 1);
    }
}

TEST(Turned, SourcesGoBackToTheExemplar) {
  const Request request = turned_by({ramp({21, 17})}, 1.0f / 24, 0.5f);
  const Turned turned(request);
  const Exemplar& copy = turned.request().exemplars.at(0);
  SourceMap sources(copy.image.size());
  for (int y = 0; y < sources.size.height; ++y)
    for (int x = 0; x < sources.size.width; ++x) *sources.at(x, y) = {x, y, 0};
  turned.name_sources(sources);
  int inside = 0;
  for (int y = 0; y < sources.size.height; ++y)
    for (int x = 0; x < sources.size.width; ++x) {
      if (*copy.mask.at(x, y) < 0.5f) continue;
      ++inside;
      const Source from = *sources.at(x, y);
      EXPECT_NEAR(*copy.image.at(x, y),
                  static_cast<float>(from.x) + 100 * static_cast<float>(from.y), 60)
          << "half a pixel each way, and what a cubic overshoots";
    }
  EXPECT_GT(inside, 21 * 17);
}

TEST(Turned, NormalsTurnWithTheirPicture) {
  for (const GreenAxis green : {GreenAxis::up, GreenAxis::down}) {
    Exemplar exemplar{Image(9, 9, 3)};
    exemplar.layers = {{"normal", MapKind::normal, 0, 3, green}};
    for (std::size_t i = 0; i < exemplar.image.pixels.size(); i += 3) {
      exemplar.image.pixels[i] = 0.9f;  // leans to the right
      exemplar.image.pixels[i + 1] = 0.5f;
      exemplar.image.pixels[i + 2] = 0.8f;
    }
    const Turned turned(turned_by(exemplar, 0.25f, 0));
    const float* normal = turned.request().exemplars.at(0).image.at(4, 4);
    EXPECT_NEAR(normal[0], 0.5f, 1e-4f);
    EXPECT_NEAR(normal[1], green == GreenAxis::up ? 0.9f : 0.1f, 1e-4f);
  }
}

TEST(Turned, MaskedPixelsStayOut) {
  Exemplar exemplar{ramp({32, 32}), {}, Image(32, 32, 1, 1.0f)};
  for (int y = 10; y < 20; ++y)
    for (int x = 10; x < 20; ++x) *exemplar.mask.at(x, y) = 0;
  const Turned turned(turned_by(exemplar, 0.1f, -0.5f));
  const Exemplar& copy = turned.request().exemplars.at(0);
  SourceMap sources(copy.image.size());
  for (int y = 0; y < sources.size.height; ++y)
    for (int x = 0; x < sources.size.width; ++x) *sources.at(x, y) = {x, y, 0};
  turned.name_sources(sources);
  for (int y = 0; y < sources.size.height; ++y)
    for (int x = 0; x < sources.size.width; ++x)
      if (*copy.mask.at(x, y) > 0.5f) {
        const Source from = *sources.at(x, y);
        EXPECT_EQ(*exemplar.mask.at(static_cast<int>(from.x), static_cast<int>(from.y)), 1);
      }
}

TEST(Turned, FiltersSeeNothingOfMaskedPixels) {
  Exemplar exemplar{Image(40, 40, 1, 0.5f), {}, Image(40, 40, 1, 1.0f)};
  for (int y = 10; y < 20; ++y)
    for (int x = 10; x < 20; ++x) {
      *exemplar.image.at(x, y) = 1;
      *exemplar.mask.at(x, y) = 0;
    }
  for (const float scale : {-1.3f, 0.0f, 0.5f}) {
    const Turned turned(turned_by(exemplar, 1.0f / 12, scale));
    const Exemplar& copy = turned.request().exemplars.at(0);
    for (std::size_t p = 0; p < copy.image.pixels.size(); ++p)
      if (copy.mask.pixels[p] > 0.5f) {
        ASSERT_NEAR(copy.image.pixels[p], 0.5f, 1e-4f);
      }
  }
}

TEST(Turned, CopiesStayWithinTheirPixels) {
  Request request{{{ramp({600, 600})}}, {{64, 64}}};
  request.target.turn = Image(64, 64, 2);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) request.target.turn.at(x, y)[0] = static_cast<float>(x) / 64;
  const Turned turned(request);
  double pixels = 0;
  for (const Exemplar& copy : turned.request().exemplars)
    pixels += 1.0 * copy.image.width * copy.image.height;
  EXPECT_LE(pixels, Turned::most_pixels);
  EXPECT_GE(turned.request().exemplars.size(), 6u);
}

}  // namespace
}  // namespace gramloom
