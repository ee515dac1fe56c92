// Syntheses that are directed: masks, several exemplars, known pixels, guides, weights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/threads.h"
#include "neural/flow/first_fill.h"
#include "neural/guidance.h"
#include "neural/guide_draws.h"
#include "neural/loss/barycentre.h"
#include "neural/loss/patch_list.h"
#include "neural/loss/patches.h"
#include "neural/quarter_means.h"
#include "neural/settings.h"
#include "syntheses.h"
#include "tensors.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

// Patches alone, quick; with the layout that is asked for.
NeuralParams quick(Layout layout) {
  NeuralParams params = quick_patches();
  params.spectrum_weight = with_preset(params.preset).spectrum_weight;
  params.levels = 2;
  params.layout = layout;
  if (layout == Layout::flow) params.flow_steps = {3};
  return params;
}

Image rectangle(Size size, int x, int y, int width, int height, float inside, float outside) {
  Image image(size, 1, outside);
  for (int v = y; v < y + height; ++v)
    for (int u = x; u < x + width; ++u) *image.at(u, v) = inside;
  return image;
}

// f(x, y) as a picture of so many equal channels.
template <class F>
Image picture(Size size, int channels, F&& f) {
  Image image(size, channels);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < channels; ++c) image.at(x, y)[c] = f(x, y);
  return image;
}

Image grain(Size size, float mean, std::uint64_t seed) {
  Random random(seed);
  return picture(size, 1, [&](int, int) { return mean + 0.1f * (random.uniform() - 0.5f); });
}

Image run(const NeuralParams& params, const Request& request) {
  return synthesise(params, request, {}).image;
}

double mean_of(const Image& image, int x, int y, int width, int height) {
  double sum = 0;
  for (int v = y; v < y + height; ++v)
    for (int u = x; u < x + width; ++u) sum += *image.at(u, v);
  return sum / width / height;
}

TEST(NeuralDirected, WhatIsMaskedCountsForNothing) {
  for (const Layout layout : {Layout::noise, Layout::flow}) {
    Request request;
    const Image clean = stripes({56, 48}, 2);
    request.exemplars = {{clean}};
    request.exemplars[0].mask = rectangle(clean.size(), 10, 4, 12, 9, 0, 1);
    request.target = {{40, 44}, Tile::x};
    const Image first = run(quick(layout), request);
    for (int y = 4; y < 13; ++y)
      for (int x = 10; x < 22; ++x) request.exemplars[0].image.at(x, y)[1] = 7;
    EXPECT_EQ(run(quick(layout), request), first);
    request.exemplars[0].image = clean;
    request.exemplars[0].mask = {};
    EXPECT_NE(run(quick(layout), request), first);
  }
}

TEST(NeuralDirected, SeveralExemplarsAreOneMaterial) {
  Request request;
  request.exemplars = {{grain({48, 48}, 0.2f, 1)}, {grain({40, 56}, 0.8f, 2)}};
  request.target = {{64, 64}, Tile::both};
  NeuralParams params = quick(Layout::noise);
  params.iterations = {60};
  const Image image = run(params, request);
  const auto bright = std::ranges::count_if(image.pixels, [](float v) { return v > 0.5f; });
  EXPECT_GT(bright, 64 * 64 / 4);
  EXPECT_LT(bright, 64 * 64 * 3 / 4);
}

Request hole_in(const Image& image, Image hole, Tile tile = Tile::none) {
  Request request;
  request.exemplars = {{image}};
  request.exemplars[0].mask =
      picture(image.size(), 1, [&](int x, int y) { return *hole.at(x, y) > 0.5f ? 0.0f : 1.0f; });
  request.target = {image.size(), tile, image, std::move(hole)};
  return request;
}

TEST(NeuralDirected, FillsContinueWhatIsKnownBitForBit) {
  const Size size{64, 64};
  const Image whole =
      picture(size, 3, [](int x, int y) { return (x / 4 + y / 4) % 2 == 0 ? 0.1f : 0.9f; });
  for (const Image& hole :
       {rectangle(size, 21, 18, 17, 14, 1, 0), rectangle(size, 0, 40, 9, 24, 1, 0)}) {
    Request request = hole_in(whole, hole);
    for (std::size_t i = 0; i < hole.pixels.size(); ++i)  // what a hole holds does not matter
      if (hole.pixels[i] > 0) request.target.known.pixels[3 * i] = 5;
    const Image image = run(quick(Layout::flow), request);
    float most = 0;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        for (int c = 0; c < 3; ++c) {
          const float off = std::abs(image.at(x, y)[c] - whole.at(x, y)[c]);
          if (*hole.at(x, y) > 0)
            most = std::max(most, off);
          else
            ASSERT_EQ(off, 0);
        }
    EXPECT_LT(most, 0.1f);
  }
}

// 128 pixels on each side, or as much as the holes are large.
TEST(NeuralDirected, AFillLooksAtWhatIsAroundItsHolesAlone) {
  const Size size{420, 300};
  const Image whole = stripes(size, 3);
  Request request;
  request.exemplars = {{whole}};
  request.exemplars[0].mask = rectangle(size, 10, 20, 12, 14, 0, 1);
  request.target = {.size = size, .known = whole, .mask = rectangle(size, 10, 20, 12, 14, 1, 0)};
  NeuralParams params = quick(Layout::noise);
  params.levels = 0;
  const Image first = run(params, request);
  const auto change = [&](int x, int y) {
    for (Image* image : {&request.exemplars[0].image, &request.target.known})
      image->at(x, y)[0] = 9;
  };
  change(22 + 128, 20);
  change(10, 34 + 128);
  const Image second = run(params, request);
  int different = 0;
  for (std::size_t i = 0; i < first.pixels.size(); ++i)
    different += first.pixels[i] != second.pixels[i] ? 1 : 0;
  EXPECT_EQ(different, 2);
  EXPECT_EQ(second.at(150, 20)[0], 9);

  // From another picture, that is seen whole.
  request.exemplars[0] = {stripes({96, 64}, 3)};
  const Image third = run(params, request);
  EXPECT_EQ(third.size(), size);
  EXPECT_EQ(third.at(150, 20)[0], 9);

  // Stopped at once, it has its whole size nevertheless.
  Control control;
  control.progress = [](const Progress&) { return false; };
  EXPECT_EQ(synthesise(params, request, control).image.size(), size);

  RequestSize asked = size_of(request);
  EXPECT_FALSE(asked.exemplars[0].filled);
  EXPECT_EQ(asked.around, (Size{22 + 128, 34 + 128}));
  RequestSize all = asked;
  all.around = size;
  EXPECT_LT(estimate(params, asked).bytes, 0.8 * estimate(params, all).bytes);
}

TEST(NeuralDirected, AFillsWindowIsOnlyWhereItCanBe) {
  const Size size{420, 300};
  Request request;
  request.exemplars = {{stripes(size, 3)}};
  request.exemplars[0].mask = rectangle(size, 10, 20, 12, 14, 0, 1);
  request.target = {.size = size,
                    .known = request.exemplars[0].image,
                    .mask = rectangle(size, 10, 20, 12, 14, 1, 0)};
  const auto looks_around = [](const Request& asked, const NeuralParams& params) {
    return neural::fills_window(params, size_of(asked));
  };
  NeuralParams params = quick(Layout::noise);
  EXPECT_FALSE(looks_around(request, params)) << "it asks for levels, which may need the whole";
  params.levels = 0;
  EXPECT_TRUE(looks_around(request, params));
  EXPECT_TRUE(size_of(request).exemplars[0].filled);
  Request tiling = request;
  tiling.target.tile = Tile::x;
  EXPECT_FALSE(looks_around(tiling, params));
  Request barred = request;
  barred.exemplars[0].mask = rectangle(size, 0, 0, 150, 160, 0, 1);
  EXPECT_FALSE(looks_around(barred, params)) << "nothing about the hole may be used";
}

// Weights that differ in the picture, though not about the hole, are not one mix.
TEST(NeuralDirected, AFillsWindowDoesNotChangeWhatAMixIs) {
  const Size size{420, 300};
  Request request;
  request.exemplars = {{stripes({96, 64}, 3)}, {stripes({96, 64}, 3)}};
  request.target = {
      .size = size, .known = stripes(size, 3), .mask = rectangle(size, 10, 20, 12, 14, 1, 0)};
  request.target.weights = Image(size, 2, 1.0f);
  request.target.weights.at(400, 100)[0] = 3;
  NeuralParams params = quick(Layout::flow);
  params.levels = 0;
  EXPECT_NO_THROW(run(params, request));
}

TEST(NeuralDirected, FillsGoOnAcrossEdgesThatWrap) {
  const Size size{64, 64};
  const Image whole = picture(size, 1, [](int x, int) { return x / 4 % 2 == 0 ? 0.1f : 0.9f; });
  const Image hole = picture(size, 1, [](int x, int) { return x < 6 || x > 57 ? 1.0f : 0.0f; });
  for (const Layout layout : {Layout::noise, Layout::flow}) {
    const Image image = run(quick(layout), hole_in(whole, hole, Tile::x));
    double off = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      off += std::abs(image.pixels[i] - whole.pixels[i]);
    EXPECT_LT(off / (12 * 64), 0.15);
  }
}

TEST(NeuralDirected, GoOnToTheSameBytes) {
  const Image image = stripes({64, 56}, 2);
  Request request = hole_in(image, rectangle(image.size(), 20, 20, 16, 14, 1, 0));
  request.exemplars[0].guide = request.target.guide =
      picture(image.size(), 1, [](int x, int) { return x < 30 ? 0.0f : 1.0f; });
  for (const Layout layout : {Layout::noise, Layout::flow}) {
    const NeuralParams params = quick(layout);
    const fs::path checkpoint = fs::path(testing::TempDir()) / "neural_directed.checkpoint";
    fs::remove(checkpoint);
    const Image whole = run(params, request);
    set_thread_count(1);
    EXPECT_EQ(run(params, request), whole);
    set_thread_count(0);
    for (const std::int64_t stop : {2, 4, 7, 10}) {
      Trace first, second;
      synthesise(params, request, first.control(stop, checkpoint));
      EXPECT_EQ(synthesise(params, request, second.control(-1, checkpoint)).image, whole)
          << "stopped at " << stop;
      fs::remove(checkpoint);
    }
  }
}

TEST(NeuralDirected, LabelsSayWhatGoesWhere) {
  const Size size{96, 48};
  Request request;
  const Image dark = grain(size, 0.2f, 1), bright = grain(size, 0.8f, 2);
  const auto label = [](bool second, Image& guide, int x, int y) {
    guide.at(x, y)[second ? 1 : 0] = 1;
  };
  Image guide(size, 2);
  Exemplar exemplar{dark};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (x >= 48) *exemplar.image.at(x, y) = *bright.at(x, y);
      label(x >= 48, guide, x, y);
    }
  exemplar.guide = guide;
  request.exemplars = {exemplar};
  request.target.size = {56, 56};
  request.target.guide = Image(request.target.size, 2);
  request.target.guide_weight = Image(1, 1, 1, 10.0f);
  const auto is_second = [](int x, int y) {
    return (x - 28) * (x - 28) + (y - 28) * (y - 28) < 300;
  };
  for (int y = 0; y < 56; ++y)
    for (int x = 0; x < 56; ++x) label(is_second(x, y), request.target.guide, x, y);
  for (const Layout layout : {Layout::noise, Layout::flow}) {
    NeuralParams params = quick(layout);
    params.iterations = {30};
    const Image image = run(params, request);
    int right = 0;
    for (int y = 0; y < 56; ++y)
      for (int x = 0; x < 56; ++x) right += (*image.at(x, y) > 0.5f) == is_second(x, y) ? 1 : 0;
    EXPECT_GT(right, 0.97 * 56 * 56) << to_word(layout);
  }
}

TEST(NeuralDirected, WeightsMixStatistics) {
  Request request;
  request.exemplars = {{grain({48, 48}, 0.2f, 1)}, {grain({48, 48}, 0.8f, 2)}};
  request.target = {{64, 48}, Tile::none};
  request.target.weights = Image(1, 1, 2, 1.0f);
  request.target.weights.pixels[1] = 3;
  NeuralParams params = quick(Layout::automatic);
  params.iterations = {60};
  EXPECT_NEAR(mean_of(run(params, request), 0, 0, 64, 48), 0.65, 0.03);
  request.target.weights = picture(request.target.size, 2, [](int, int) { return 0.0f; });
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const float share = std::clamp((static_cast<float>(x) - 16) / 32, 0.0f, 1.0f);
      request.target.weights.at(x, y)[0] = 1 - share;
      request.target.weights.at(x, y)[1] = share;
    }
  const Image ramp = run(params, request);
  EXPECT_NEAR(mean_of(ramp, 0, 0, 12, 48), 0.2, 0.04);
  EXPECT_NEAR(mean_of(ramp, 28, 0, 8, 48), 0.5, 0.1);
  EXPECT_NEAR(mean_of(ramp, 52, 0, 12, 48), 0.8, 0.04);
}

TEST(NeuralDirected, WhatCannotBeHonouredIsRefusedByName) {
  const Image image = stripes({64, 64}, 1);
  const Request fill = hole_in(image, rectangle(image.size(), 20, 20, 16, 14, 1, 0));
  const auto refusal = [](const NeuralParams& params, const Request& request) -> std::string {
    try {
      synthesise(params, request, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  NeuralParams params = quick(Layout::noise);
  params.spectrum_weight = 0.3;
  EXPECT_THAT(refusal(params, fill), testing::HasSubstr("spectrum_weight"));
  EXPECT_THAT(refusal(with_preset(Preset::gatys), fill), testing::HasSubstr("gram_weight"));
  EXPECT_THROW(estimate(with_preset(Preset::gatys), size_of(fill)), Error);
  params = quick(Layout::noise);
  params.match_histogram = true;
  EXPECT_THAT(refusal(params, fill), testing::HasSubstr("match_histogram"));
  Request mix;
  mix.exemplars = {{image}, {image}};
  mix.target = {{32, 32}};
  mix.target.weights = Image(1, 1, 2, 1.0f);
  EXPECT_THAT(refusal(quick(Layout::flow), mix), testing::HasSubstr("weights"));
  Request masked;
  masked.exemplars = {{image}};
  masked.exemplars[0].mask = rectangle(image.size(), 5, 5, 4, 4, 1, 0);
  masked.target = {{32, 32}};
  EXPECT_THAT(refusal(quick(Layout::noise), masked), testing::HasSubstr("patch_sizes"));
}

TEST(NeuralDirected, CostsWhatIsMade) {
  const Image image = stripes({256, 256}, 1);
  const Request small = hole_in(image, rectangle(image.size(), 20, 20, 16, 14, 1, 0));
  const Request large = hole_in(image, rectangle(image.size(), 20, 20, 160, 140, 1, 0));
  EXPECT_LT(2 * seconds(estimate({}, size_of(small)).work),
            seconds(estimate({}, size_of(large)).work));
  Request several;
  several.exemplars = {{image}, {image}, {image}};
  Request one;
  one.exemplars = {{image}};
  EXPECT_GT(estimate({}, size_of(several)).bytes, estimate({}, size_of(one)).bytes);
}

}  // namespace

namespace neural {
namespace {

TEST(PatchList, IsSomeOfAllPatches) {
  const at::Tensor planes = numbers({2, 13, 11}, 1), filters = numbers({5, 2, 3, 3}, 2);
  std::vector<PatchPlace> places;
  std::vector<std::int64_t> indices;
  for (const std::int64_t i : {0, 10, 11, 40, 77, 142}) {  // some go on across the edges
    places.push_back({static_cast<int>(i % 11), static_cast<int>(i / 11)});
    indices.push_back(i);
  }
  const at::Tensor index = at::tensor(indices, at::kLong);
  const at::Tensor all = project_patches(planes, filters, Tile::both);
  const at::Tensor some = project_list(planes, filters, places);
  EXPECT_LT(relative_difference(some, all.index_select(1, index)), 1e-5);
  const at::Tensor slopes = numbers({5, 6}, 3);
  at::Tensor spread = at::zeros_like(planes), goal = at::zeros_like(planes);
  spread_list(slopes, filters, places, spread);
  spread_patches(at::zeros_like(all).index_copy(1, index, slopes), filters, Tile::both, goal);
  EXPECT_LT(relative_difference(spread, goal), 1e-5);
}

TEST(Barycentre, AveragesQuantiles) {
  const at::Tensor a = at::tensor({0.0f, 1.0f, 2.0f}).view({1, 3}),
                   b = at::tensor({10.0f, 30.0f, 50.0f}).view({1, 3});
  const at::Tensor mean = barycentre({a, b}, {0.75f, 0.25f}, 3);
  EXPECT_LT(relative_difference(mean, at::tensor({2.5f, 8.25f, 14.0f}).view({1, 3})), 1e-6);
}

TEST(QuarterMeans, AreThoseOfEachQuarter) {
  Random random(1);
  Image guide({9, 7}, 2);
  for (float& v : guide.pixels) v = random.uniform();
  const Image means = quarter_means(guide, 5);  // quarters of 2 × 2, 3 apart
  for (int quarter = 0; quarter < 4; ++quarter) {
    float sum = 0;
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x)
        sum += guide.at((7 + x + quarter % 2 * 3) % 9, (5 + y + quarter / 2 * 3) % 7)[1];
    EXPECT_NEAR(means.at(7, 5)[quarter * 2 + 1], sum / 4, 1e-6);
  }
}

TEST(GuideDraws, AreOfLikeGuides) {
  GuideRows exemplar{1, {}}, wanted{1, {0.1f, 0.9f, 3}};
  for (int i = 0; i < 100; ++i) exemplar.values.push_back(static_cast<float>(i) / 99);
  const GuideDraws draws(exemplar, wanted, {10, 10, 0});
  Random random(1);
  double sums[3] = {};
  for (int i = 0; i < 500; ++i)
    for (std::int64_t w = 0; w < 3; ++w)
      sums[w] += exemplar.values[static_cast<std::size_t>(draws.draw(w, random))] / 500;
  EXPECT_NEAR(sums[0], 0.1, 0.03);
  EXPECT_NEAR(sums[1], 0.9, 0.03);
  EXPECT_NEAR(sums[2], 0.5, 0.05);  // of no weight: any
}

TEST(ScaledMask, IsUsableWhereAllBelowIs) {
  Image mask({7, 5}, 1, 1.0f);
  *mask.at(3, 2) = 0;
  const Image half = scaled_mask(mask, {4, 3});
  int unusable = 0;
  for (const float v : half.pixels) unusable += v == 0 ? 1 : 0;
  EXPECT_EQ(*half.at(1, 1), 0);
  EXPECT_EQ(unusable, 2);  // pixel 3 of 7 lies under two of 4
  EXPECT_EQ(scaled_mask(mask, mask.size()), mask);
}

TEST(StepsToKnown, AreThoseOfAKing) {
  Image made({9, 9}, 1);
  for (int y = 2; y < 7; ++y)
    for (int x = 1; x < 8; ++x) *made.at(x, y) = 1;
  const auto steps = steps_to_known(made);
  EXPECT_EQ(steps[made.index(4, 4)], 3);
  EXPECT_EQ(steps[made.index(1, 4)], 1);
  EXPECT_EQ(steps[made.index(0, 0)], 0);
}

TEST(FirstFill, ContinuesStripes) {
  const Image whole =
      picture({40, 40}, 1, [](int x, int y) { return static_cast<float>((x + 2 * y) % 7) / 7; });
  Guidance guidance;
  guidance.made = rectangle(whole.size(), 12, 9, 15, 18, 1, 0);
  Image damaged = whole;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    if (guidance.made.pixels[i] > 0) damaged.pixels[i] = 3;
  EXPECT_EQ(first_fill(guidance, damaged, whole, 8), whole);
}

}  // namespace
}  // namespace neural
}  // namespace gramloom
