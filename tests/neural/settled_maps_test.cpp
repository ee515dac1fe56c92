// Maps of a synthesised picture, as its colours tell them.
#include "neural/settled_maps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "core/threads.h"
#include "neural/groups.h"
#include "neural/shared_rows.h"
#include "signal/blur.h"

namespace gramloom::neural {
namespace {

constexpr Size settled_size{120, 90};

// Waves of colour that tile, with grain, and two maps: a function of the colours, and white noise.
Exemplar told_and_not(std::uint64_t seed) {
  Exemplar exemplar{Image(settled_size, 5),
                    {{"", MapKind::colour, 0, 3},
                     {"height", MapKind::scalar, 3, 1},
                     {"noise", MapKind::scalar, 4, 1}}};
  Random random(seed);
  const double phase = static_cast<double>(seed);
  for (int y = 0; y < settled_size.height; ++y)
    for (int x = 0; x < settled_size.width; ++x) {
      float* p = exemplar.image.at(x, y);
      const double u = 2 * M_PI * x / settled_size.width, v = 2 * M_PI * y / settled_size.height;
      for (int c = 0; c < 3; ++c)
        p[c] = static_cast<float>(
            0.5 + 0.2 * std::sin((4 + c) * u + 3 * v + phase) * std::cos(5 * v - c * u) +
            0.05 * (double{random.uniform()} - 0.5));
      p[3] = 0.3f * p[0] + 0.6f * p[1] * p[1];
      p[4] = random.uniform();
    }
  return exemplar;
}

double error_of_height(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 5) {
    const float* p = image.pixels.data() + i;
    const double d = double{0.3f * p[0] + 0.6f * p[1] * p[1]} - double{p[3]};
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(image.pixels.size() / 5));
}

// Another picture of the same colours, with a grain of its own on every map.
Image unsettled() {
  Image image = told_and_not(7).image;
  Random random(8);
  for (std::size_t i = 0; i < image.pixels.size(); i += 5)
    image.pixels[i + 3] += 0.1f * (random.uniform() - 0.5f);
  return image;
}

Image settled(const Exemplar& exemplar, Image image, Tile tile) {
  const std::vector<Layer> layers = told_layers(exemplar, Random(1));
  settle_maps(exemplar, layers, tile, Random(1), {image, 0, image.height}, {0, image.height},
              one_process(), image);
  return image;
}

TEST(SettledMaps, AreThoseThatTheColoursTell) {
  const std::vector<Layer> layers = told_layers(told_and_not(1), Random(1));
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers.front().name, "height");
  Exemplar alone = told_and_not(1);
  alone.layers.resize(1);
  alone.image = extract_channels(alone.image, 0, 3);
  EXPECT_TRUE(told_layers(alone, Random(1)).empty());
}

// However smooth it is, so that each of its places is like others of itself.
TEST(SettledMaps, AMapDoesNotTellItself) {
  Exemplar exemplar = told_and_not(1);
  Image noise(settled_size, 1);
  Random random(5);
  for (float& value : noise.pixels) value = random.uniform();
  noise = blurred(noise, 3, Tile::both);
  for (std::size_t i = 0; i < noise.pixels.size(); ++i)
    exemplar.image.pixels[5 * i + 4] = noise.pixels[i];
  const std::vector<Layer> layers = told_layers(exemplar, Random(1));
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers.front().name, "height");
}

TEST(SettledMaps, FollowTheColours) {
  const Exemplar exemplar = told_and_not(1);
  const Image before = unsettled();
  for (const Tile tile : {Tile::none, Tile::x, Tile::both}) {
    const Image after = settled(exemplar, before, tile);
    EXPECT_LT(error_of_height(after), 0.25 * error_of_height(before));
    for (std::size_t i = 0; i < after.pixels.size(); ++i) {
      if (i % 5 == 3) continue;
      ASSERT_EQ(after.pixels[i], before.pixels[i]) << "what is not told stays";
    }
  }
}

// A map that colours tell by its large forms alone keeps the exemplar's grain.
TEST(SettledMaps, HaveTheGrainOfTheExemplars) {
  const auto with_grain = [](Exemplar exemplar) {
    Random random(3);
    for (std::size_t i = 0; i < exemplar.image.pixels.size(); i += 5)
      exemplar.image.pixels[i + 3] += 0.06f * (random.uniform() - 0.5f);
    return exemplar;
  };
  const auto steps = [](const Image& image) {
    double sum = 0;
    for (std::size_t i = 5; i < image.pixels.size(); i += 5) {
      const double d = double{image.pixels[i + 3]} - double{image.pixels[i - 2]};
      sum += d * d;
    }
    return sum;
  };
  const Exemplar exemplar = with_grain(told_and_not(1));
  const Image after = settled(exemplar, unsettled(), Tile::both);
  EXPECT_NEAR(steps(after) / steps(exemplar.image), 1, 0.1);
}

// Of a picture that several processes have together each settles its own rows, to the same values.
TEST(SettledMaps, OfSharedRowsAreThoseOfTheWhole) {
  const Exemplar exemplar = told_and_not(1);
  const Image before = unsettled();
  const std::vector<Layer> layers = told_layers(exemplar, Random(1));
  for (const Tile tile : {Tile::none, Tile::both}) {
    const Image whole = settled(exemplar, before, tile);
    together(3, [&](const Group& group) {
      const Rows rows = own_rows(group, before.height);
      const auto part = [&](std::int64_t begin, std::int64_t end) {
        Image image(before.width, static_cast<int>(end - begin), before.channels);
        for (std::int64_t y = begin; y < end; ++y)
          std::copy_n(before.at(0, static_cast<int>((y + before.height) % before.height)),
                      before.width * before.channels, image.at(0, static_cast<int>(y - begin)));
        return image;
      };
      const Image around = part(rows.begin - settled_margin, rows.end + settled_margin);
      Image own = part(rows.begin, rows.end);
      settle_maps(exemplar, layers, tile, Random(1),
                  {around, rows.begin - settled_margin, before.height}, rows, group, own);
      for (int y = 0; y < own.height; ++y)
        for (int i = 0; i < own.width * own.channels; ++i)
          ASSERT_NEAR(own.at(0, y)[i], whole.at(0, static_cast<int>(rows.begin) + y)[i], 1e-6)
              << y << " of rows from " << rows.begin;
    });
  }
}

TEST(SettledMaps, DoNotDependOnTheNumberOfThreads) {
  const Exemplar exemplar = told_and_not(1);
  const Image before = unsettled();
  set_thread_count(1);
  const Image one = settled(exemplar, before, Tile::both);
  set_thread_count(3);
  const Image three = settled(exemplar, before, Tile::both);
  set_thread_count(0);
  EXPECT_EQ(one, three);
}

}  // namespace
}  // namespace gramloom::neural
