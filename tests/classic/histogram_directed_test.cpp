#include <gtest/gtest.h>

#include "classic/histogram.h"
#include "classic/markov.h"
#include "core/threads.h"
#include "directed_requests.h"

namespace gramloom {
namespace {

template <class Params>
class DirectedDrawing : public testing::Test {};
using Drawing = testing::Types<HistogramParams, MarkovParams>;
TYPED_TEST_SUITE(DirectedDrawing, Drawing);

TYPED_TEST(DirectedDrawing, NeverUsesMaskedPixelsAndUsesEveryExemplar) {
  Request request{
      {{blobs(40, 30, 2, 1)}, {blobs(30, 40, 2, 2)}}, {{80, 70}, Tile::both}, Random(4)};
  request.exemplars[0].mask = rectangle({40, 30}, 5, 5, 20, 20, 0);
  const Texture texture = synthesise(TypeParam{}, request, {});
  EXPECT_EQ(masked_sources(texture, request), 0);
  // Equally likely: by their usable pixels, 800 and 1200.
  const bool independent = std::is_same_v<TypeParam, HistogramParams>;
  EXPECT_NEAR(shares(texture, 2)[0], 0.4, independent ? 0.03 : 0.15);
  EXPECT_EQ(texture.image, arranged(texture.source, request.exemplars));
}

TYPED_TEST(DirectedDrawing, KnownPixelsStay) {
  const Image picture = blobs(60, 50, 3, 3);
  const Image hole = rectangle({60, 50}, 20, 10, 25, 40, 1);
  const Request request = fill_request(picture, hole);
  const Texture texture = synthesise(TypeParam{}, request, {});
  EXPECT_EQ(different(texture.image, picture, hole, false), 0);
  EXPECT_EQ(masked_sources(texture, request), 0);
}

TEST(DirectedHistogram, DrawsExemplarsByTheirWeights) {
  Request request{{{blobs(40, 30, 2, 1)}, {blobs(30, 40, 2, 2)}}, {{100, 100}}, Random(4)};
  request.target.weights = Image({100, 100}, 2);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      request.target.weights.at(x, y)[0] = x < 50 ? 3.0f : 0.0f;
      request.target.weights.at(x, y)[1] = x < 50 ? 1.0f : 2.0f;
    }
  const Texture texture = synthesise(HistogramParams{}, request, {});
  int left = 0, right = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) (x < 50 ? left : right) += texture.source.at(x, y)->exemplar == 0;
  EXPECT_NEAR(left, 0.75 * 5000, 150);
  EXPECT_EQ(right, 0);
}

TEST(DirectedMarkov, ContinuesStripesInAHole) {
  Image picture(60, 50, 1);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) *picture.at(x, y) = x % 6 < 3 ? 1.0f : 0.0f;
  const Image hole = rectangle({60, 50}, 17, 10, 25, 30, 1);
  const Texture texture = synthesise(MarkovParams{.order = 6}, fill_request(picture, hole), {});
  EXPECT_EQ(different(texture.image, picture, hole, true), 0);
}

}  // namespace
}  // namespace gramloom
