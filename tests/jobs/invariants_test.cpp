// What every method promises, whatever it is asked: the ordinary cases. See requests_test.cpp for
// the rest.
#include <algorithm>
#include <limits>

#include "jobs/every_method.h"

namespace gramloom {
namespace {

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
class Invariants : public OfMethod<Params> {};
TYPED_TEST_SUITE(Invariants, EveryMethod, KindNames);

TYPED_TEST(Invariants, SizesLargerSmallerAndNotSquare) {
  const Image exemplar = grain({48, 40}, 3);
  for (const Size size : {Size{48, 40}, Size{96, 70}, Size{31, 64}, Size{20, 15}, Size{101, 33}})
    this->expect_sound(this->make(exemplar, size), exemplar, size);
}

TYPED_TEST(Invariants, AnyNumberOfChannels) {
  if (!TestFixture::takes_exemplar) GTEST_SKIP() << "takes no exemplar";
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

// A neural method: for the same number of threads.
TYPED_TEST(Invariants, SameBytesForAnyThreads) {
  const Image exemplar = grain({48, 40}, 3);
  for (const Tile tile : {Tile::none, Tile::both}) {
    set_thread_count(1);
    Image image = this->make(exemplar, {96, 80}, 1, tile);
    for (const int threads : {1, 2, 8}) {
      set_thread_count(threads);
      if (TestFixture::is_neural) image = this->make(exemplar, {96, 80}, 1, tile);
      EXPECT_EQ(this->make(exemplar, {96, 80}, 1, tile), image) << threads << " threads";
    }
  }
}

TYPED_TEST(Invariants, ConstantInConstantOut) {
  if (!TestFixture::takes_exemplar) GTEST_SKIP() << "takes no exemplar";
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

TYPED_TEST(Invariants, LargeAndSmallValues) {
  if (!TestFixture::takes_exemplar) GTEST_SKIP() << "takes no exemplar";
  for (const float scale : {1e15f, 1e6f, 1e-6f}) {
    Image exemplar = grain({40, 32}, 2);
    for (float& value : exemplar.pixels) value *= scale;
    this->expect_sound(this->make(exemplar, {50, 40}), exemplar, {50, 40});
  }
}

TYPED_TEST(Invariants, RefusesWhatCannotBe) {
  const Image exemplar = grain({32, 32}, 3);
  EXPECT_THROW(this->make(exemplar, {0, 8}), Error);
  EXPECT_THROW(this->make(exemplar, {8, -1}), Error);
  if (!TestFixture::takes_exemplar) return;
  EXPECT_THROW(this->make(Image(), {8, 8}), Error);
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
    synthesise(this->quick(), this->request(exemplar, {{96, 96}}), control);
    EXPECT_EQ(last, stop_at < 0 ? steps : last);
    return calls;
  };
  const std::int64_t calls = run(-1);
  EXPECT_GE(calls, 2);
  if (TestFixture::is_neural) {  // gives what there is so far
    EXPECT_EQ(run(1), 1);
    EXPECT_EQ(run((calls + 1) / 2), (calls + 1) / 2);
  } else {
    EXPECT_THROW(run(1), Interrupted);
    EXPECT_THROW(run((calls + 1) / 2), Interrupted);
  }
}

TYPED_TEST(Invariants, EstimateGrowsWithTheWork) {
  const auto cost = [](int side, int channels) {
    RequestSize request{.size = {side, side}};
    if (TestFixture::takes_exemplar) request.exemplars.push_back({{128, 128}, channels});
    return estimate(TypeParam{}, request);
  };
  EXPECT_GT(cost(64, 1).bytes, 0);
  EXPECT_GT(seconds(cost(64, 1).work), 0);
  EXPECT_GT(cost(512, 3).bytes, cost(256, 3).bytes);
  EXPECT_GT(seconds(cost(512, 3).work), seconds(cost(256, 3).work));
  EXPECT_LT(cost(1024, 3).bytes, TestFixture::is_neural ? 1e9 : 300e6);
}

TYPED_TEST(Invariants, DefaultsAreInTheirRanges) {
  EXPECT_NO_THROW(check_fields(TypeParam{}));
  EXPECT_FALSE(TypeParam::summary.empty());
}

}  // namespace
}  // namespace gramloom
