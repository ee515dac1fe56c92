// What every method that can be directed promises: fill, masks, guides, several exemplars and
// mixing. The methods are those of the program's own list that say they can.
#include <gmock/gmock.h>

#include <algorithm>

#include "jobs/every_method.h"
#include "metrics/seams.h"

namespace gramloom {
namespace {

/// Two halves: grain, and the same much brighter, which no blend of its own values reaches.
Image halves(Size size, int channels) {
  Image image = grain(size, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = image.width / 2; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) image.at(x, y)[c] += 10;
  return image;
}

/// 1 in the left half (or the right one).
Image half_mask(Size size, bool left) {
  Image mask(size, 1);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      *mask.at(x, y) = (x < mask.width / 2) == left ? 1.0f : 0.0f;
  return mask;
}

/// One-hot labels of two: 0 in the left half, 1 in the right one; turned for a target.
Image labels(Size size, bool swapped) {
  Image guide(size, 2);
  for (int y = 0; y < guide.height; ++y)
    for (int x = 0; x < guide.width; ++x)
      guide.at(x, y)[((x < guide.width / 2) == swapped) ? 1 : 0] = 1;
  return guide;
}

/// A hole in the middle, and one at the border.
Image holes(Size size) {
  Image mask(size, 1);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const bool middle = x > mask.width / 3 && x < mask.width / 2 && y > mask.height / 3 &&
                          y < mask.height * 2 / 3;
      const bool border = x >= mask.width - 9 && y < 12;
      if (middle || border) *mask.at(x, y) = 1;
    }
  return mask;
}

Image inverted(Image mask) {
  for (float& value : mask.pixels) value = 1 - value;
  return mask;
}

template <class Params>
class Directed : public OfMethod<Params> {
 protected:
  static constexpr bool can(Ability ability) { return Params::abilities.has(ability); }

  /// With steps enough to bring a colour from noise.
  static Params enough() {
    Params params = OfMethod<Params>::quick();
    if constexpr (OfMethod<Params>::is_neural) params.iterations = {60, 60};
    return params;
  }

  /// The picture itself with its holes masked, to be filled.
  static Request filling(const Image& picture, const Image& mask, Tile tile = Tile::none) {
    Request request{{{picture}}, {picture.size(), tile}, Random(1)};
    if (can(Ability::mask)) request.exemplars[0].mask = inverted(mask);
    request.target.known = picture;
    request.target.mask = mask;
    // What is to be made is not to be seen.
    for (std::size_t p = 0; p < mask.pixels.size(); ++p)
      if (mask.pixels[p] > 0)
        for (int c = 0; c < picture.channels; ++c)
          request.target.known.pixels[p * static_cast<std::size_t>(picture.channels) +
                                      static_cast<std::size_t>(c)] = -50;
    return request;
  }
};
TYPED_TEST_SUITE(Directed, EveryMethod, KindNames);

TYPED_TEST(Directed, KnownPixelsComeBackBitForBit) {
  if (!this->can(Ability::fill)) GTEST_SKIP() << "cannot fill";
  const Image picture = grain({72, 60}, 3);
  for (const Tile tile : {Tile::none, Tile::both}) {
    const Image mask = holes(picture.size());
    const Request request = this->filling(picture, mask, tile);
    const Texture texture = synthesise(this->quick(), request, {});
    ASSERT_EQ(texture.image.size(), picture.size());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      if (mask.pixels[i / 3] == 0) {
        ASSERT_EQ(texture.image.pixels[i], picture.pixels[i]) << "value " << i;
      } else {
        ASSERT_GT(texture.image.pixels[i], -1) << "not made: " << i;
      }
  }
}

TYPED_TEST(Directed, JoinsOfAFillShowLessWhenTheyAreBlended) {
  if (!this->can(Ability::fill) || !this->copies) GTEST_SKIP() << "copies nothing into a picture";
  const Image picture = grain({72, 60}, 3);
  const Image mask = holes(picture.size());
  Request request = this->filling(picture, mask);
  for (Exemplar& exemplar : request.exemplars)  // nothing fits: it is darker throughout
    for (float& value : exemplar.image.pixels) value -= 0.1f;
  const Texture copied = run_method(this->quick(), request, {});
  request.target.blend = 4;
  const Texture blended = run_method(this->quick(), request, {});
  EXPECT_EQ(blended.source.pixels, copied.source.pixels);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    if (mask.pixels[i / 3] == 0) {
      ASSERT_EQ(blended.image.pixels[i], picture.pixels[i]) << "value " << i;
    }
  const double before = join_visibility(copied.image, mask);
  if (std::is_same_v<TypeParam, HistogramParams>)
    EXPECT_EQ(blended.image, copied.image) << "pixels that are copied one by one have no steps";
  else if (std::is_base_of_v<MarkovParams, TypeParam>)  // pieces in one of the holes alone
    EXPECT_LE(join_visibility(blended.image, mask), before);
  else
    EXPECT_LT(join_visibility(blended.image, mask), 0.9 * before);
}

TYPED_TEST(Directed, MaskedPixelsAreNeverUsed) {
  if (!this->can(Ability::mask)) GTEST_SKIP() << "has no masks";
  Request request = this->request(halves({64, 48}, 3), {{60, 50}});
  for (const bool left : {true, false}) {
    request.exemplars[0].mask = half_mask({64, 48}, left);
    const Texture texture = synthesise(this->quick(), request, {});
    for (const float value : texture.image.pixels) {
      ASSERT_EQ(value < 5, left) << value;
    }
    for (const Source& source : texture.source.pixels) {
      ASSERT_EQ(source.x < 32, left);
    }
  }
}

TYPED_TEST(Directed, LabelsAreHonoured) {
  if (!this->can(Ability::guide)) GTEST_SKIP() << "follows no guide";
  Request request = this->request(halves({64, 48}, 3), {{72, 60}});
  request.exemplars[0].guide = labels({64, 48}, false);
  request.target.guide = labels({72, 60}, true);
  request.target.guide_weight = Image(1, 1, 1, 10.0f);
  const Image image = synthesise(this->enough(), request, {}).image;
  int right = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      right += (image.at(x, y)[0] > 5) == (x < image.width / 2) ? 1 : 0;
  EXPECT_GT(right, 0.99 * image.width * image.height);
}

TYPED_TEST(Directed, BothOfTwoExemplarsAreUsed) {
  if (!this->can(Ability::exemplars)) GTEST_SKIP() << "takes one exemplar";
  Image brighter = grain({40, 52}, 3);
  for (float& value : brighter.pixels) value += 0.2f;
  Request request = this->request(grain({48, 40}, 3), {{96, 80}});
  request.exemplars.push_back({brighter});
  const Texture texture = synthesise(this->quick(), request, {});
  if (!this->copies) {
    // Brighter than the darker one ever is, and darker than the brighter one.
    const auto [low, high] = std::ranges::minmax(texture.image.pixels);
    EXPECT_LT(low, *std::ranges::min_element(brighter.pixels));
    EXPECT_GT(high, *std::ranges::max_element(request.exemplars[0].image.pixels));
    return;
  }
  std::array<int, 2> used{};
  for (const Source& source : texture.source.pixels) ++used.at(source.exemplar);
  EXPECT_GT(used[0], 200);
  EXPECT_GT(used[1], 200);
  EXPECT_EQ(arranged(texture.source, request.exemplars), texture.image);
}

TYPED_TEST(Directed, AWeightPictureSaysWhichOfTwoExemplarsGoesWhere) {
  if (!this->can(Ability::mix)) GTEST_SKIP() << "does not mix";
  Image brighter = grain({48, 40}, 3);
  for (float& value : brighter.pixels) value += 10;
  Request request = this->request(grain({48, 40}, 3), {{96, 60}});
  request.exemplars.push_back({brighter});
  request.target.weights = labels({96, 60}, false);
  const Image image = synthesise(this->enough(), request, {}).image;
  double left = 0, right = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      (x < image.width / 2 ? left : right) += static_cast<double>(image.at(x, y)[0]);
  EXPECT_LT(left / (48 * 60), 2.5);
  EXPECT_GT(right / (48 * 60), 8.5);
}

TYPED_TEST(Directed, WeightsThatAreEverywhereTheSameAreShares) {
  if (!this->can(Ability::mix)) GTEST_SKIP() << "does not mix";
  Image brighter = grain({48, 40}, 3);
  for (float& value : brighter.pixels) value += 10;
  Request request = this->request(grain({48, 40}, 3), {{160, 120}});
  request.exemplars.push_back({brighter});
  request.target.weights = Image(1, 1, 2);
  request.target.weights.pixels = {3, 1};
  const Image image = synthesise(this->enough(), request, {}).image;
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
    sum += double{image.pixels[i]};
  EXPECT_NEAR(sum / (160 * 120), 0.5 + 10 * 0.25, 1.5);
}

TYPED_TEST(Directed, SameBytesForAnyThreads) {
  if (!this->can(Ability::fill) && !this->can(Ability::mask)) GTEST_SKIP() << "is not directed";
  if (TestFixture::is_neural) GTEST_SKIP() << "the same for the same number of threads";
  const Image picture = grain({72, 60}, 3);
  Request request = this->request(picture, {{72, 60}});
  if (this->can(Ability::fill)) request = this->filling(picture, holes(picture.size()));
  if (this->can(Ability::mask)) request.exemplars[0].mask = half_mask({72, 60}, true);
  if (this->can(Ability::guide)) {
    request.exemplars[0].guide = labels({72, 60}, false);
    request.target.guide = labels({72, 60}, false);
  }
  set_thread_count(1);
  const Image image = synthesise(this->quick(), request, {}).image;
  for (const int threads : {2, 5}) {
    set_thread_count(threads);
    EXPECT_EQ(synthesise(this->quick(), request, {}).image, image) << threads << " threads";
  }
}

/// Methods that copy continue what repeats exactly.
TYPED_TEST(Directed, PatternsAreContinuedExactly) {
  if (!this->can(Ability::fill) || !this->copies || TypeParam::kind == "histogram" ||
      TypeParam::kind.starts_with("markov"))
    GTEST_SKIP() << "does not fill by copying what fits";
  const auto stripes = [](int x, int) { return x / 3 % 2; };
  const auto board = [](int x, int y) { return (x / 4 + y / 4) % 2; };
  const auto bricks = [](int width, int height) {
    return [=](int x, int y) {
      return y % height < 2 || (x + (y / height % 2) * (width / 2)) % width < 2 ? 0 : 1;
    };
  };
  struct Hole {
    const char* where;
    int left, top;
  };
  const auto check = [&](const std::string& name, auto&& value) {
    Image picture(128, 96, 1);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) *picture.at(x, y) = static_cast<float>(value(x, y));
    for (const Hole hole :
         {Hole{"inside", 50, 30}, {"at the border", 104, 30}, {"corner", 0, 72}}) {
      // A joint that the picture's edge cuts is one pixel wide or two: neighbourhoods of 3 pixels
      // do not see the one that would tell.
      if (TypeParam::kind == "pixel" && hole.left == 0) continue;
      Image mask(128, 96, 1);
      for (int y = hole.top; y < hole.top + 24; ++y)
        for (int x = hole.left; x < hole.left + 24; ++x) *mask.at(x, y) = 1;
      const Image image = synthesise(this->quick(), this->filling(picture, mask), {}).image;
      int wrong = 0;
      for (std::size_t p = 0; p < image.pixels.size(); ++p)
        wrong += std::abs(image.pixels[p] - picture.pixels[p]) > 1e-3f ? 1 : 0;
      EXPECT_EQ(wrong, 0) << name << ", " << hole.where << ", of 576 pixels";
    }
  };
  check("stripes", stripes);
  check("checkerboard", board);
  for (const auto& [width, height] : {std::pair{16, 8}, {16, 12}, {20, 10}, {24, 12}})
    check(fmt::format("bricks of {}×{}", width, height), bricks(width, height));
}

}  // namespace
}  // namespace gramloom
