// What the whole of score() and its controls promise, for every metric and any image.
#include "metrics/scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/threads.h"
#include "metrics/controls.h"
#include "metrics/exemplar_statistics.h"
#include "metrics/pictures.h"

namespace gramloom {
namespace {

void expect_sound(const Scores& scores, const Image& image) {
  for (const auto& [name, value] : scores.values) EXPECT_TRUE(std::isfinite(value)) << name;
  for (const char* name :
       {"stsim2", "copy_correlation", "copied_share", "copy_coherence", "repetition"}) {
    EXPECT_GE(value(scores, name), 0) << name;
    EXPECT_LE(value(scores, name), 1 + 1e-9) << name;
  }
  ASSERT_EQ(scores.copy_map.size(), image.size());
  ASSERT_EQ(scores.copy_map.channels, 3);
  for (const float v : scores.copy_map.pixels) ASSERT_TRUE(v >= 0 && v <= 1);
}

TEST(Scores, AreThoseOfTheListInItsOrder) {
  const Image image = grain({32, 32}, 3);
  const Scores scores = score(image, image, Tile::both);
  std::vector<std::string_view> names, listed;
  for (const auto& [name, value] : scores.values) names.push_back(name);
  for (const Metric& metric : metrics())
    if (metric.name != "diversity" && metric.name != "join")  // of several, of a filled picture
      listed.push_back(metric.name);
  EXPECT_EQ(names, listed);
  for (const Metric& metric : metrics()) {
    EXPECT_FALSE(metric.meaning.empty()) << metric.name;
    EXPECT_FALSE(metric.range.empty()) << metric.name;
    EXPECT_FALSE(metric.fooled_by.empty()) << metric.name;
  }
  EXPECT_EQ(std::set(listed.begin(), listed.end()).size(), listed.size());
  EXPECT_EQ(score(image, image, Tile::x).values.size(), names.size() - 1);
  EXPECT_EQ(score(image, image, Tile::none).values.size(), names.size() - 2);
}

TEST(Scores, AnyNumberOfChannels) {
  for (const int channels : {1, 2, 3, 4, 5, 64}) {
    const Image exemplar = grain({40, 36}, channels, 1), image = grain({30, 44}, channels, 2);
    expect_sound(score(exemplar, image, Tile::both), image);
  }
}

TEST(Scores, AnySizes) {
  const std::vector<Size> sizes{{1, 1}, {2, 1}, {1, 9}, {15, 16}, {17, 33}, {64, 23}, {131, 101}};
  for (const Size a : sizes)
    for (const Size b : sizes) {
      const Image exemplar = grain(a, 2, 1), image = grain(b, 2, 2);
      expect_sound(score(exemplar, image, Tile::both), image);
    }
}

TEST(Scores, FlatImagesAndHugeValues) {
  const Image noise = grain({40, 40}, 3);
  Image huge = noise;
  for (float& v : huge.pixels) v *= 1e6f;
  const std::vector<Image> images{noise, Image(40, 40, 3, 0.5f), Image(30, 50, 3), huge};
  for (const Image& exemplar : images)
    for (const Image& image : images) expect_sound(score(exemplar, image, Tile::both), image);
  const Scores same = score(images[1], images[1], Tile::both);
  EXPECT_NEAR(value(same, "stsim2"), 1, 1e-12);
  EXPECT_EQ(value(same, "portilla_simoncelli"), 0);
}

TEST(Scores, SameBytesForAnyThreads) {
  const Image exemplar = pebbles(), image = quilted(exemplar, {150, 117});
  set_thread_count(1);
  const Scores one = score(exemplar, image, Tile::both);
  for (const int threads : {2, 5}) {
    set_thread_count(threads);
    const Scores more = score(exemplar, image, Tile::both);
    EXPECT_EQ(more.values, one.values) << threads;
    EXPECT_EQ(more.copy_map, one.copy_map) << threads;
  }
  set_thread_count(0);
}

TEST(Scores, OfAnExemplarForManyPicturesAreThoseOfEach) {
  const Image exemplar = pebbles();
  ExemplarStatistics statistics(exemplar);
  // Other sizes ask for other levels and rings; the first ones must still be there afterwards.
  const std::vector<Image> images{pebbles(2), grain({40, 36}, 3), brick(1, 192), pebbles(2)};
  for (const Image& image : images) {
    const Scores one = score(exemplar, image, Tile::both);
    const Scores many = score(statistics, image, Tile::both);
    EXPECT_EQ(many.values, one.values);
    EXPECT_EQ(many.copy_map, one.copy_map);
  }
}

TEST(Scores, RefuseWhatCannotBeCompared) {
  const Image good = grain({20, 20}, 3);
  EXPECT_THROW(score(Image(), good, Tile::none), Error);
  EXPECT_THROW(score(good, Image(), Tile::none), Error);
  EXPECT_THROW(score(good, grain({20, 20}, 1), Tile::none), Error);
  EXPECT_THROW(score(grain({4, 4}, 65), grain({4, 4}, 65), Tile::none), Error);
  Image broken = good;
  broken.pixels[7] = std::nanf("");
  EXPECT_THROW(score(good, broken, Tile::none), Error);
  EXPECT_THROW(score(broken, good, Tile::none), Error);
}

TEST(Scores, ReportStepsAndStopWhenAsked) {
  const Image image = grain({32, 32}, 1);
  std::int64_t last = -1, steps = 0;
  Control control;
  control.progress = [&](const Progress& p) {
    EXPECT_GT(p.step, last);
    last = p.step;
    steps = p.steps;
    return true;
  };
  score(image, image, Tile::none, control);
  EXPECT_EQ(last, steps);
  control.progress = [](const Progress& p) { return p.step < 2; };
  EXPECT_THROW(score(image, image, Tile::none, control), Interrupted);
}

TEST(Controls, ShuffledPixelsAreThoseOfTheExemplar) {
  const Image exemplar = grain({12, 10}, 3);
  const auto sorted_pixels = [](const Image& image) {
    std::vector<std::vector<float>> pixels;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        pixels.emplace_back(image.at(x, y), image.at(x, y) + image.channels);
    std::sort(pixels.begin(), pixels.end());
    return pixels;
  };
  const ControlPair same = control_pair(ControlKind::shuffled, exemplar, {12, 10}, Random(1));
  EXPECT_EQ(same.exemplar, exemplar);
  EXPECT_NE(same.image, exemplar);
  EXPECT_EQ(sorted_pixels(same.image), sorted_pixels(exemplar));
  const ControlPair twice = control_pair(ControlKind::shuffled, exemplar, {24, 10}, Random(1));
  EXPECT_EQ(sorted_pixels(twice.image), sorted_pixels(window(exemplar, 0, 0, {24, 10})));
}

TEST(Controls, TiledAndHalves) {
  const Image exemplar = grain({13, 10}, 2);
  EXPECT_EQ(control_pair(ControlKind::tiled, exemplar, {30, 25}, Random(1)).image,
            window(exemplar, 0, 0, {30, 25}));
  const ControlPair halves = control_pair(ControlKind::halves, exemplar, {99, 99}, Random(1));
  EXPECT_EQ(halves.exemplar, window(exemplar, 0, 0, {6, 10}));
  EXPECT_EQ(halves.image, window(exemplar, 6, 0, {6, 10}));
  const Image tall = grain({3, 8}, 1);
  EXPECT_EQ(control_pair(ControlKind::halves, tall, {1, 1}, Random(1)).image,
            window(tall, 0, 4, {3, 4}));
}

TEST(Controls, OfAnySizeOrAnError) {
  const Image exemplar = grain({20, 16}, 3);
  for (const ControlKind kind :
       {ControlKind::shuffled, ControlKind::random_phase, ControlKind::tiled})
    for (const Size size : {Size{1, 1}, Size{9, 40}, Size{64, 64}}) {
      const ControlPair pair = control_pair(kind, exemplar, size, Random(1));
      EXPECT_EQ(pair.image.size(), size);
      EXPECT_EQ(pair.image, control_pair(kind, exemplar, size, Random(1)).image);
    }
  EXPECT_THROW(control_pair(ControlKind::halves, Image(1, 1, 1), {4, 4}, Random(1)), Error);
  EXPECT_THROW(control_pair(ControlKind::tiled, exemplar, {0, 4}, Random(1)), Error);
  EXPECT_THROW(control_pair(ControlKind::shuffled, Image(), {4, 4}, Random(1)), Error);
}

}  // namespace
}  // namespace gramloom
