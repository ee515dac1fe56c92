// What every method that makes a texture from an exemplar promises, for every one of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "classic/histogram.h"
#include "classic/markov.h"
#include "classic/patchmatch.h"
#include "classic/phase.h"
#include "classic/pixel.h"
#include "classic/pyramid.h"
#include "classic/quilting.h"
#include "core/error.h"
#include "core/threads.h"

namespace gramloom {
namespace {

/// Smooth grain with some correlation between its channels.
Image grain(Size size, int channels) {
  Image image(size, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) {
        const double u = x, v = y;
        const double waves = std::sin(0.61 * u + 1.3 * std::sin(0.37 * v)) +
                             std::sin(0.53 * v + 1.1 * std::sin(0.29 * u) + 0.4 * c) +
                             0.5 * std::sin(0.9 * u - 0.7 * v + c);
        image.at(x, y)[c] = static_cast<float>(0.5 + 0.15 * waves);
      }
  return image;
}

/// Mean absolute step between column (or row) `at` and its successor around the image.
double step_across(const Image& image, bool columns, int at) {
  const int across = columns ? image.width : image.height;
  const int along = columns ? image.height : image.width;
  double sum = 0;
  for (int i = 0; i < along; ++i)
    for (int c = 0; c < image.channels; ++c) {
      const int next = (at + 1) % across;
      const float* a = columns ? image.at(at, i) : image.at(i, at);
      const float* b = columns ? image.at(next, i) : image.at(i, next);
      sum += std::abs(static_cast<double>(a[c] - b[c]));
    }
  return sum / (along * image.channels);
}

/// The step across the seam over the largest step inside the image.
double seam_ratio(const Image& image, bool columns) {
  const int across = columns ? image.width : image.height;
  double inside = 0;
  for (int at = 0; at + 1 < across; ++at)
    inside = std::max(inside, step_across(image, columns, at));
  return step_across(image, columns, across - 1) / inside;
}

template <class Params>
class Invariants : public testing::Test {
 protected:
  void TearDown() override { set_thread_count(0); }

  static Image make(const Image& exemplar, Size size, std::uint64_t seed = 1,
                    Tile tile = Tile::none) {
    return synthesise(Params{}, {{{exemplar}}, Target{size, tile}, Random(seed)}, Control{}).image;
  }

  static void expect_sound(const Image& image, const Image& exemplar, Size size) {
    ASSERT_EQ(image.size(), size);
    ASSERT_EQ(image.channels, exemplar.channels);
    const ChannelRange range = channel_range(exemplar);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const std::size_t c = i % static_cast<std::size_t>(image.channels);
      ASSERT_TRUE(std::isfinite(image.pixels[i]));
      ASSERT_GE(image.pixels[i], range.low[c]);
      ASSERT_LE(image.pixels[i], range.high[c]);
    }
  }
};

/// Variants of a method that take paths of their own are listed beside its defaults.
struct CausalMarkov : MarkovParams {
  static constexpr std::string_view kind = "markov_causal";
  CausalMarkov() { neighbourhood = MarkovNeighbourhood::causal; }
};

// The one list: a method added here is held to all of it.
using Methods = testing::Types<HistogramParams, MarkovParams, CausalMarkov, PhaseParams,
                               PyramidParams, PixelParams, QuiltingParams, PatchmatchParams>;

struct KindNames {
  template <class Params>
  static std::string GetName(int) {
    return std::string(Params::kind);
  }
};
TYPED_TEST_SUITE(Invariants, Methods, KindNames);

TYPED_TEST(Invariants, SizesLargerSmallerAndNotSquare) {
  const Image exemplar = grain({48, 40}, 3);
  for (const Size size : {Size{48, 40}, Size{96, 70}, Size{31, 64}, Size{20, 15}, Size{101, 33}})
    this->expect_sound(this->make(exemplar, size), exemplar, size);
}

TYPED_TEST(Invariants, AnyNumberOfChannels) {
  for (const int channels : {1, 2, 3, 4, 5, 6, 7, 8, 64}) {
    const Image exemplar = grain({32, 32}, channels);
    this->expect_sound(this->make(exemplar, {40, 36}), exemplar, {40, 36});
  }
}

TYPED_TEST(Invariants, SameSeedSameBytesOtherSeedOtherImage) {
  const Image exemplar = grain({40, 40}, 3);
  const Image image = this->make(exemplar, {56, 56}, 7);
  EXPECT_EQ(this->make(exemplar, {56, 56}, 7), image);
  EXPECT_NE(this->make(exemplar, {56, 56}, 8), image);
}

TYPED_TEST(Invariants, SameBytesForAnyThreads) {
  const Image exemplar = grain({48, 40}, 3);
  for (const Tile tile : {Tile::none, Tile::both}) {
    set_thread_count(1);
    const Image image = this->make(exemplar, {96, 80}, 1, tile);
    for (const int threads : {2, 8}) {
      set_thread_count(threads);
      EXPECT_EQ(this->make(exemplar, {96, 80}, 1, tile), image) << threads << " threads";
    }
  }
}

TYPED_TEST(Invariants, ConstantInConstantOut) {
  Image exemplar(32, 24, 3);
  for (std::size_t i = 0; i < exemplar.pixels.size(); ++i)
    exemplar.pixels[i] = 0.1f + 0.3f * static_cast<float>(i % 3);
  const Image image = this->make(exemplar, {50, 40});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_EQ(image.pixels[i], exemplar.pixels[i % 3]);
}

TYPED_TEST(Invariants, TilesOnEachAxis) {
  const Image exemplar = grain({64, 64}, 2);
  for (const Tile tile : {Tile::x, Tile::y, Tile::both})
    for (const Size size : {Size{72, 60}, Size{48, 50}})
      for (const std::uint64_t seed : {1u, 2u}) {
        const Image image = this->make(exemplar, size, seed, tile);
        this->expect_sound(image, exemplar, size);
        if (tiles_x(tile)) {
          EXPECT_LT(seam_ratio(image, true), 1.1) << "seed " << seed;
        }
        if (tiles_y(tile)) {
          EXPECT_LT(seam_ratio(image, false), 1.1) << "seed " << seed;
        }
      }
}

TYPED_TEST(Invariants, TinyExemplarsGiveSoundImagesOrAnError) {
  for (const Size tiny : {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{5, 3}, Size{40, 2}})
    for (const Tile tile : {Tile::none, Tile::both})
      for (const Size size : {Size{24, 20}, Size{1, 1}, Size{2, 30}}) {
        const Image exemplar = grain(tiny, 3);
        try {
          this->expect_sound(this->make(exemplar, size, 1, tile), exemplar, size);
        } catch (const Error& error) {
          EXPECT_GT(std::string(error.what()).size(), 10u);
        }
      }
}

TYPED_TEST(Invariants, TargetsSmallerThanAnyPatch) {
  const Image exemplar = grain({48, 40}, 3);
  for (const Tile tile : {Tile::none, Tile::x, Tile::both})
    for (const Size size : {Size{1, 1}, Size{1, 40}, Size{50, 1}, Size{2, 2}, Size{3, 7}})
      this->expect_sound(this->make(exemplar, size, 1, tile), exemplar, size);
}

TYPED_TEST(Invariants, LargeAndSmallValues) {
  for (const float scale : {1e15f, 1e6f, 1e-6f}) {
    Image exemplar = grain({40, 32}, 2);
    for (float& value : exemplar.pixels) value *= scale;
    this->expect_sound(this->make(exemplar, {50, 40}), exemplar, {50, 40});
  }
}

TYPED_TEST(Invariants, RefusesWhatCannotBe) {
  const Image exemplar = grain({32, 32}, 3);
  EXPECT_THROW(this->make(Image(), {8, 8}), Error);
  EXPECT_THROW(this->make(exemplar, {0, 8}), Error);
  EXPECT_THROW(this->make(exemplar, {8, -1}), Error);
  Image broken = exemplar;
  for (const float value : {std::nanf(""), std::numeric_limits<float>::infinity(), -3e38f, 2e15f}) {
    broken.pixels[100] = value;
    EXPECT_THROW(this->make(broken, {8, 8}), Error) << value;
  }
}

TYPED_TEST(Invariants, ReportsItsStepsAndStopsWhenAsked) {
  const Image exemplar = grain({48, 48}, 3);
  const auto run = [&](std::int64_t stop_at) {
    std::int64_t calls = 0, last = -1, steps = -1;
    Control control;
    control.progress = [&](const Progress& p) {
      EXPECT_GE(p.step, last);
      EXPECT_LE(p.step, p.steps);
      last = p.step;
      steps = p.steps;
      return ++calls != stop_at;
    };
    synthesise(TypeParam{}, {{{exemplar}}, Target{{96, 96}}, Random(1)}, control);
    EXPECT_EQ(last, steps);
    return calls;
  };
  const std::int64_t calls = run(-1);
  EXPECT_GE(calls, 2);
  EXPECT_THROW(run(1), Interrupted);
  EXPECT_THROW(run((calls + 1) / 2), Interrupted);
}

TYPED_TEST(Invariants, EstimateGrowsWithTheWork) {
  const auto cost = [](int side, int channels) {
    return estimate(TypeParam{}, {{{{128, 128}, channels}}, {side, side}});
  };
  EXPECT_GT(cost(64, 1).bytes, 0);
  EXPECT_GT(cost(64, 1).seconds, 0);
  EXPECT_GT(cost(512, 3).bytes, cost(256, 3).bytes);
  EXPECT_GT(cost(512, 3).seconds, cost(256, 3).seconds);
  EXPECT_LT(cost(1024, 3).bytes, 300e6);
}

TYPED_TEST(Invariants, DefaultsAreInTheirRanges) {
  EXPECT_NO_THROW(check_fields(TypeParam{}));
  EXPECT_FALSE(TypeParam::summary.empty());
}

}  // namespace
}  // namespace gramloom
