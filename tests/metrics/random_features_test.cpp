#include "metrics/random_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/threads.h"
#include "metrics/components.h"
#include "metrics/controls.h"
#include "metrics/pictures.h"

namespace gramloom {
namespace {

constexpr std::size_t count = RandomFeatures::count;

RandomFeatures features_of(const Image& exemplar, const Image& image) {
  return random_features(components(image, colour_frame(exemplar)));
}
RandomFeatures features_of(const Image& image) { return features_of(image, image); }

double distance_of(const Image& exemplar, const Image& image) {
  return gram_distance(features_of(exemplar), features_of(exemplar, image));
}

Image scaled(Image image, float factor) {
  for (float& value : image.pixels) value *= factor;
  return image;
}

void expect_equal(const RandomFeatures& a, const RandomFeatures& b) {
  ASSERT_EQ(a.scales.size(), b.scales.size());
  for (std::size_t s = 0; s < a.scales.size(); ++s) {
    EXPECT_EQ(a.scales[s].mean, b.scales[s].mean) << s;
    EXPECT_EQ(a.scales[s].moment, b.scales[s].moment) << s;
  }
}

TEST(RandomFeatures, AreTheSameEachTimeWithAnyThreads) {
  const Image image = pebbles();
  const RandomFeatures one = features_of(image);
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    expect_equal(features_of(image), one);
  }
}

TEST(RandomFeatures, HasAsManyScalesAsThePictureIsLargeEnoughFor) {
  for (const auto& [side, scales] : {std::pair{16, 1u}, {30, 1u}, {31, 2u}, {63, 3u}, {200, 4u}})
    EXPECT_EQ(random_features(grain({side, 200}, component_count)).scales.size(), scales) << side;
}

TEST(RandomFeatures, AreMoments) {
  for (const auto& scale : features_of(stones()).scales)
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_GE(scale.mean[i], 0) << "both layers are rectified";
      EXPECT_GE(scale.moment[i * count + i], scale.mean[i] * scale.mean[i] * (1 - 1e-6));
      for (std::size_t j = 0; j < count; ++j) {
        EXPECT_EQ(scale.moment[i * count + j], scale.moment[j * count + i]);
        EXPECT_LE(std::pow(scale.moment[i * count + j], 2),
                  scale.moment[i * count + i] * scale.moment[j * count + j] * (1 + 1e-5));
      }
    }
}

// The first layer's filters have mean 0, and there are no constants to add.
TEST(RandomFeatures, AFlatPictureHasNone) {
  for (const auto& scale : random_features(Image(40, 40, component_count, 0.7f)).scales) {
    for (const double mean : scale.mean) EXPECT_NEAR(mean, 0, 1e-6);
    for (const double moment : scale.moment) EXPECT_NEAR(moment, 0, 1e-6);
  }
}

TEST(RandomFeatures, GrowWithContrastAndDoNotKnowANegative) {
  const Image image = components(pebbles(), colour_frame(pebbles()));
  const RandomFeatures features = random_features(image);
  expect_equal(random_features(scaled(image, -1)), features);
  const RandomFeatures twice = random_features(scaled(image, 2));
  for (std::size_t s = 0; s < features.scales.size(); ++s)
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(twice.scales[s].mean[i], 2 * features.scales[s].mean[i],
                  1e-5 * features.scales[s].mean[i]);
      EXPECT_NEAR(twice.scales[s].moment[i * count + i],
                  4 * features.scales[s].moment[i * count + i],
                  1e-5 * features.scales[s].moment[i * count + i]);
    }
}

TEST(GramDistance, IsZeroToItself) {
  for (const Image& image : {pebbles(), brick(), grain({33, 57}, 3), Image(20, 20, 1, 0.5f)})
    EXPECT_LT(distance_of(image, image), 1e-12);
}

TEST(GramDistance, AHalfIsNearerThanShuffledPixelsAndRandomPhases) {
  for (const Image& image : {pebbles(), stones(), painted(Granite{}, 5)}) {
    const ControlPair halves = control_pair(ControlKind::halves, image, image.size(), Random(1));
    const double half = distance_of(image, halves.image);
    for (const ControlKind kind : {ControlKind::shuffled, ControlKind::random_phase})
      EXPECT_LT(half, distance_of(image, control_pair(kind, image, image.size(), Random(1)).image));
    EXPECT_LT(half, 0.3);
  }
}

TEST(GramDistance, AShiftAroundTheTorusIsLittle) {
  for (const Image& image : {pebbles(), brick(), stones()}) {
    const Image shuffled =
        control_pair(ControlKind::shuffled, image, image.size(), Random(1)).image;
    for (const auto& [x, y] : {std::pair{32, 64}, {7, 10}, {1, 0}})
      EXPECT_LT(distance_of(image, window(image, x, y, image.size())),
                0.12 * distance_of(image, shuffled))
          << x << " " << y;
  }
}

TEST(GramDistance, AnotherTextureIsFarther) {
  EXPECT_GT(distance_of(pebbles(), brick()), 2 * distance_of(pebbles(), pebbles(2)));
  EXPECT_GT(distance_of(brick(), pebbles()), 2 * distance_of(brick(), brick(2)));
}

}  // namespace
}  // namespace gramloom
