// Copies that go over into known pixels: closed forms, and what must stay as it is.

#include "signal/blended_joins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gramloom {
namespace {

/// A row of `width` pixels, known up to `first`, then copied from an exemplar that is 0.1 darker
/// there: source and target have the same coordinates.
struct Row {
  Request request;
  Texture texture;
};
Row row_of(int width, int first, float darker, int blend, int channels = 1) {
  Image picture(width, 1, channels);
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < channels; ++c)
      picture.at(x, 0)[c] = 0.5f + 0.03f * static_cast<float>(x % 3 + c);
  Image exemplar = picture;
  for (float& value : exemplar.pixels) value -= darker;
  Target target{.size = picture.size(), .known = picture, .mask = Image(width, 1, 1, 0.0f)};
  target.blend = blend;
  SourceMap source(picture.size());
  Texture texture{picture, {}, {}};
  for (int x = 0; x < width; ++x) {
    *source.at(x, 0) = {x, 0};
    if (x < first) continue;
    *target.mask.at(x, 0) = 1;
    for (int c = 0; c < channels; ++c) texture.image.at(x, 0)[c] = exemplar.at(x, 0)[c];
  }
  texture.source = std::move(source);
  return {{.exemplars = {{exemplar}}, .target = target}, texture};
}

TEST(BlendedJoins, AShiftFadesAsTheScreenedMembraneOnALineDoes) {
  const int first = 20, blend = 4;
  Row row = row_of(200, first, 0.1f, blend);
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  // Inside, e[x−1] − (2 + s) e[x] + e[x+1] = 0 with s = 1 / blend²: a geometric series; at the join
  // (2 + s) e − e[+1] = d.
  const double s = 1.0 / (blend * blend);
  const double q = (2 + s) / 2 - std::sqrt((2 + s) * (2 + s) / 4 - 1);
  const double d = 0.1;
  for (int x = first; x < first + 4 * blend; ++x) {
    const double shift = double{*row.texture.image.at(x, 0)} - double{*before.at(x, 0)};
    EXPECT_NEAR(shift, d / (2 + s - q) * std::pow(q, x - first), 2e-4) << x;
  }
  for (int x = 0; x < first; ++x) EXPECT_EQ(*row.texture.image.at(x, 0), *before.at(x, 0));
}

TEST(BlendedJoins, WhatFitsStaysACopyToTheBit) {
  Row row = row_of(60, 20, 0, 8, 3);
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  EXPECT_EQ(row.texture.image, before);
}

TEST(BlendedJoins, NothingIsDoneWithoutBlendOrSources) {
  Row row = row_of(60, 20, 0.1f, 0);
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  EXPECT_EQ(row.texture.image, before);
  row.request.target.blend = 4;
  row.texture.source = {};
  blend_joins(row.texture, row.request);
  EXPECT_EQ(row.texture.image, before);
}

TEST(BlendedJoins, WhatMayNotBeUsedIsNotLookedAt) {
  Row row = row_of(60, 20, 0.1f, 4);
  row.request.exemplars[0].mask = Image(60, 1, 1, 1.0f);
  *row.request.exemplars[0].mask.at(19, 0) = 0;  // beside the source of the join
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  EXPECT_EQ(row.texture.image, before);
}

TEST(BlendedJoins, PixelsThatWereCopiedAloneStayCopies) {
  Row row = row_of(60, 20, 0.1f, 4);
  for (int x = 20; x < 60; ++x) *row.texture.source.at(x, 0) = {x % 2 == 0 ? x : 59 - x, 0};
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  EXPECT_EQ(row.texture.image, before);
}

TEST(BlendedJoins, NormalsAndCoverageStayCopies) {
  Row row = row_of(60, 20, 0.1f, 4, 6);
  row.request.exemplars[0].layers = {{"", MapKind::scalar, 0, 1},
                                     {"", MapKind::alpha, 1, 1},
                                     {"n", MapKind::normal, 2, 3},
                                     {"height", MapKind::scalar, 5, 1}};
  for (Image* image : {&row.request.target.known, &row.texture.image})
    for (int x = 0; x < 60; ++x) image->at(x, 0)[1] += 0.2f;  // opaque enough to have joins
  for (int x = 0; x < 60; ++x) row.request.exemplars[0].image.at(x, 0)[1] += 0.2f;
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  for (int c = 0; c < 6; ++c) {
    const float shift = row.texture.image.at(20, 0)[c] - before.at(20, 0)[c];
    if (c == 0 || c == 5)
      EXPECT_GT(shift, 0.03f) << c;
    else
      EXPECT_EQ(shift, 0) << c;
  }
}

TEST(BlendedJoins, WhatIsTransparentHasNoJoins) {
  Row row = row_of(60, 20, 0.1f, 4, 2);
  row.request.exemplars[0].layers = {{"", MapKind::scalar, 0, 1}, {"", MapKind::alpha, 1, 1}};
  for (Image* image :
       {&row.request.exemplars[0].image, &row.request.target.known, &row.texture.image})
    for (int x = 0; x < 60; ++x) image->at(x, 0)[1] = 1;
  Row clear = row;
  clear.request.target.known.at(19, 0)[1] = 0;  // beside the first new pixel
  const Image before = row.texture.image;
  blend_joins(row.texture, row.request);
  EXPECT_NE(row.texture.image, before);
  blend_joins(clear.texture, clear.request);
  EXPECT_EQ(clear.texture.image, before);
}

// Holes are judged each by itself: dust elsewhere changes nothing.
TEST(BlendedJoins, AHoleOfOnePixelDoesNotSpeakForOthers) {
  Row row = row_of(120, 100, 0.1f, 4);
  Row dusty = row;
  for (int x = 1; x < 90; x += 3) {
    *dusty.request.target.mask.at(x, 0) = 1;
    *dusty.texture.image.at(x, 0) -= 0.1f;
  }
  const Image before = dusty.texture.image;
  blend_joins(row.texture, row.request);
  blend_joins(dusty.texture, dusty.request);
  for (int x = 0; x < 90; ++x) EXPECT_EQ(*dusty.texture.image.at(x, 0), *before.at(x, 0)) << x;
  for (int x = 100; x < 120; ++x)
    EXPECT_EQ(*dusty.texture.image.at(x, 0), *row.texture.image.at(x, 0)) << x;
}

TEST(BlendedJoins, ShiftsAreInProportionToTheValues) {
  Row row = row_of(60, 20, 0.1f, 4);
  Row small = row;
  for (Image* image :
       {&small.request.exemplars[0].image, &small.request.target.known, &small.texture.image})
    for (float& value : image->pixels) value *= 0x1p-14f;
  blend_joins(row.texture, row.request);
  blend_joins(small.texture, small.request);
  for (int x = 0; x < 60; ++x)
    EXPECT_EQ(*small.texture.image.at(x, 0), 0x1p-14f * *row.texture.image.at(x, 0)) << x;
}

TEST(BlendedJoins, GoAroundEdgesThatTile) {
  Row row = row_of(60, 20, 0.1f, 4);
  row.request.target.tile = Tile::x;  // the last pixel meets the first, which is known
  for (int x = 0; x < 60; ++x) *row.request.exemplars[0].image.at(x, 0) = 0.4f;
  for (int x = 0; x < 20; ++x) *row.request.target.known.at(x, 0) = 0.5f;
  for (int x = 20; x < 60; ++x) *row.texture.image.at(x, 0) = 0.4f;
  for (int x = 20; x < 60; ++x) *row.texture.source.at(x, 0) = {x - 10, 0};
  blend_joins(row.texture, row.request);
  EXPECT_GT(*row.texture.image.at(59, 0), 0.43f);
  EXPECT_NEAR(*row.texture.image.at(59, 0), *row.texture.image.at(20, 0), 1e-4);
  EXPECT_NEAR(*row.texture.image.at(40, 0), 0.4f, 0.003f);
}

TEST(BlendedJoins, ValuesStayWithinThoseOfTheTexture) {
  Row row = row_of(60, 20, 0.1f, 4);
  *row.request.exemplars[0].image.at(19, 0) = -3;  // asks for a shift of more than 3
  const auto [low, high] = std::ranges::minmax(row.texture.image.pixels);
  blend_joins(row.texture, row.request);
  for (int x = 0; x < 60; ++x) {
    EXPECT_LE(*row.texture.image.at(x, 0), high);
    EXPECT_GE(*row.texture.image.at(x, 0), low);
  }
  EXPECT_EQ(*row.texture.image.at(20, 0), high);
}

}  // namespace
}  // namespace gramloom
