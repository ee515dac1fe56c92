#include "neural/synthesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "neural/settings.h"
#include "syntheses.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

NeuralParams quick() {
  NeuralParams params = with_preset(Preset::gatys);
  params.network = "vgg_small";
  params.layers = {"relu1_1", "pool1", "pool2"};
  params.iterations = {12};
  return params;
}

TEST(Neural, TheLossFallsAHundredfold) {
  NeuralParams params = quick();
  params.iterations = {80};
  Trace trace;
  synthesise(params, {{{stripes({64, 64}, 3)}}, {{64, 64}, Tile::both}, Random(1)},
             trace.control());
  ASSERT_FALSE(trace.steps.empty());
  EXPECT_LT(trace.steps.back().loss, trace.steps.front().loss / 100);
}

TEST(Neural, ReportsEachStepWithItsTerms) {
  Trace trace;
  synthesise(quick(), {{{stripes({48, 48}, 3)}}, {{48, 40}, Tile::none}, Random(1)},
             trace.control());
  ASSERT_EQ(trace.steps.size(), 12u);
  for (std::size_t i = 0; i < trace.steps.size(); ++i) {
    const Progress& p = trace.steps[i];
    EXPECT_EQ(p.step, static_cast<std::int64_t>(i) + 1);
    EXPECT_EQ(p.steps, 12);
    EXPECT_GE(p.evaluations, p.step);
    ASSERT_EQ(p.terms.size(), 3u);
    EXPECT_EQ(p.terms[1].name, "gram_pool1");
    double sum = 0;
    for (const auto& term : p.terms) sum += term.value;
    EXPECT_NEAR(sum, p.loss, 1e-3 * p.loss);
  }
}

TEST(Neural, TheSeedDecides) {
  const Image exemplar = stripes({40, 40}, 3);
  const Target target{{32, 48}, Tile::both};
  for (const NeuralParams& params : {quick(), quick_patches()}) {
    const Image once = run(params, exemplar, target, 1);
    EXPECT_EQ(once, run(params, exemplar, target, 1));
    EXPECT_NE(once, run(params, exemplar, target, 2));
  }
}

TEST(Neural, AnySizeAndChannelsWithinTheExemplarsRange) {
  for (const int channels : {1, 2, 4, 6})
    for (const Size size : {Size{24, 56}, Size{33, 31}}) {
      const Image exemplar = stripes({44, 36}, channels);
      for (const auto padding :
           {Padding::circular, Padding::reflect, Padding::zero, Padding::valid}) {
        NeuralParams params = quick();
        params.iterations = {3};
        params.padding = padding;
        params.layers = {"relu1_1", "pool1"};
        const Image result = run(params, exemplar, {size, Tile::x});
        EXPECT_EQ(result.size(), size);
        EXPECT_EQ(result.channels, channels);
        const ChannelRange range = channel_range(exemplar), own = channel_range(result);
        for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
          EXPECT_GE(own.low[c], range.low[c]);
          EXPECT_LE(own.high[c], range.high[c]);
        }
      }
    }
}

TEST(Neural, AConstantExemplarGivesAConstantImage) {
  const Image flat({32, 32}, 3, 0.25f);
  for (const char* network : {"vgg_small", "multiscale"}) {
    NeuralParams params = with_preset(Preset::gatys);
    params.network = network;
    params.iterations = {5};
    const Image result = run(params, flat, {{32, 32}, Tile::both});
    for (const float value : result.pixels) ASSERT_EQ(value, 0.25f);
  }
}

TEST(Neural, AnOnlyPixelOrALineIsAClearErrorOrAResult) {
  for (const Size size : {Size{1, 1}, Size{1, 40}}) {
    try {
      const Image result = run(quick(), Image(size, 3, 0.5f), {{32, 32}, Tile::none});
      for (const float value : result.pixels) EXPECT_TRUE(std::isfinite(value));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("too small"), std::string::npos);
    }
  }
}

TEST(Neural, TrainedWeightsForOtherChannelsAreAClearError) {
  NeuralParams params = quick();
  params.network = "vgg19";
  params.weights = testing::TempDir() + "unread.safetensors";
  try {
    run(params, stripes({64, 64}, 4), {{64, 64}, Tile::none});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("look at 3 channels, the exemplar has 4"),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(estimate(params, {{{{64, 64}, 4}}, {64, 64}, Tile::none}), Error);
}

TEST(Neural, WeightsThatAreNotThereAreAMistakeOfTheConfig) {
  NeuralParams params = quick();
  params.weights = "no_such_weights";
  EXPECT_THROW(estimate(params, {{{{64, 64}, 3}}, {64, 64}, Tile::none}), ConfigError);
}

TEST(Neural, CoarseToFineEndsAtTheFinestSize) {
  NeuralParams params = quick();
  params.levels = 3;
  params.level_factor = 0.6;
  params.iterations = {4};
  Trace trace;
  const Texture texture = synthesise(
      params, {{{stripes({64, 64}, 3)}}, {{50, 70}, Tile::both}, Random(1)}, trace.control());
  EXPECT_EQ(texture.image.size(), (Size{50, 70}));
  EXPECT_EQ(trace.steps.back().step, 12);
  EXPECT_EQ(trace.steps.back().steps, 12);
}

// Of neighbours along rows: the mean across the seam, as a part of the mean inside.
double step_at_the_seam(const Image& image) {
  double seam = 0, inside = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const int next = (x + 1) % image.width;
      (next == 0 ? seam : inside) += std::abs(*image.at(next, y) - *image.at(x, y));
    }
  return seam * (image.width - 1) / inside;
}

// No step of the optimiser: what enlarging does from level to level.
TEST(Neural, TheSeamIsAsSmoothAsTheRest) {
  Image exemplar(128, 128, 1);
  Random random(1);
  for (float& value : exemplar.pixels) value = random.uniform();
  NeuralParams params = with_preset(Preset::fast);
  params.iterations = {0};
  constexpr int seeds = 16;
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    mean +=
        step_at_the_seam(
            synthesise(params, {{{exemplar}}, {{128, 128}, Tile::both}, Random(seed)}, {}).image) /
        seeds;
  EXPECT_GT(mean, 0.75);
  EXPECT_LT(mean, 1.25);
}

TEST(Neural, StopsByLossAndBySeconds) {
  NeuralParams params = quick();
  params.iterations = {200};
  params.stop_loss = 0.3;
  Trace by_loss;
  synthesise(params, {{{stripes({48, 48}, 3)}}, {{48, 48}, Tile::both}, Random(1)},
             by_loss.control());
  EXPECT_LT(by_loss.steps.size(), 200u);
  EXPECT_LE(by_loss.steps.back().loss, 0.3 * by_loss.steps.front().loss);
  params.stop_loss = 0;
  params.stop_seconds = 0;
  Trace by_seconds;
  synthesise(params, {{{stripes({48, 48}, 3)}}, {{48, 48}, Tile::both}, Random(1)},
             by_seconds.control());
  EXPECT_EQ(by_seconds.steps.size(), 1u);
}

TEST(Neural, HistogramMatchingGivesTheExemplarsValues) {
  NeuralParams params = quick();
  params.match_histogram = true;
  const Image exemplar = stripes({40, 40}, 3);
  Image result = run(params, exemplar, {{40, 40}, Tile::both});
  auto sorted = [](const Image& image) {
    std::vector<float> red;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) red.push_back(image.pixels[i]);
    std::sort(red.begin(), red.end());
    return red;
  };
  EXPECT_EQ(sorted(result), sorted(exemplar));
}

// The exemplar has room for many levels; the texture, which does not wrap, has not.
TEST(Neural, LevelsEndWhereAPatchNoLongerFits) {
  for (const Size size : {Size{16, 40}, Size{9, 9}}) {
    NeuralParams params;
    params.padding = Padding::reflect;
    params.iterations = {2};
    const Target target{size, Tile::none};
    EXPECT_EQ(run(params, stripes({160, 200}, 3), target).size(), size);
    params.coarsest_side = 4;
    EXPECT_EQ(run(params, stripes({40, 30}, 1), {{64, 64}, Tile::both}).width, 64);
  }
}

TEST(Neural, WhatIsSmallerThanAPatchIsRefusedBeforehand) {
  const NeuralParams params;
  const Target target{{64, 64}, Tile::both};
  EXPECT_NO_THROW(estimate(params, {{{{7, 7}, 3}}, target.size, target.tile}));
  EXPECT_THROW(estimate(params, {{{{6, 40}, 3}}, target.size, target.tile}), Error);
}

class Interrupted : public testing::TestWithParam<Optimizer> {};

TEST_P(Interrupted, GoesOnToTheSameBytes) {
  NeuralParams params = quick();
  params.optimizer = {GetParam()};
  params.levels = 2;
  const Image exemplar = stripes({48, 48}, 3);
  const Target target{{48, 48}, Tile::both};
  const fs::path checkpoint =
      fs::path(testing::TempDir()) / fmt::format("neural_{}.checkpoint", to_word(GetParam()));
  fs::remove(checkpoint);
  const Image whole = run(params, exemplar, target);
  for (const std::int64_t stop : {1, 7, 12, 13, 20}) {
    Trace first, second;
    synthesise(params, {{{exemplar}}, target, Random(1)}, first.control(stop, checkpoint));
    EXPECT_EQ(first.steps.back().step, stop);
    ASSERT_TRUE(fs::exists(checkpoint));
    const Image resumed =
        synthesise(params, {{{exemplar}}, target, Random(1)}, second.control(-1, checkpoint)).image;
    EXPECT_EQ(second.steps.front().step, stop + 1);
    EXPECT_EQ(resumed, whole) << "stopped at " << stop;
    fs::remove(checkpoint);
  }
}

TEST_P(Interrupted, StaysStoppedWhereItsLossWasLowEnough) {
  NeuralParams params = quick();
  params.optimizer = {GetParam()};
  params.levels = 2;
  params.iterations = {200};
  params.stop_loss = 0.5;
  const Image exemplar = stripes({48, 48}, 3);
  const Target target{{48, 48}, Tile::both};
  const fs::path checkpoint =
      fs::path(testing::TempDir()) / fmt::format("loss_{}.checkpoint", to_word(GetParam()));
  fs::remove(checkpoint);
  Trace whole, first, second;
  const Image expected =
      synthesise(params, {{{exemplar}}, target, Random(1)}, whole.control()).image;
  const auto last_coarse = std::find_if(whole.steps.rbegin(), whole.steps.rend(),
                                        [](const auto& p) { return p.step <= 200; });
  synthesise(params, {{{exemplar}}, target, Random(1)},
             first.control(last_coarse->step, checkpoint));
  const Image resumed =
      synthesise(params, {{{exemplar}}, target, Random(1)}, second.control(-1, checkpoint)).image;
  EXPECT_EQ(second.steps.front().step, 201);
  EXPECT_EQ(resumed, expected);
  fs::remove(checkpoint);
}

TEST_P(Interrupted, OnACoarseLevelThePictureHasItsSizeAllTheSame) {
  NeuralParams params = quick();
  params.optimizer = {GetParam()};
  params.levels = 2;
  Trace trace;
  const Texture texture = synthesise(
      params, {{{stripes({48, 48}, 3)}}, {{50, 38}, Tile::x}, Random(1)}, trace.control(2));
  EXPECT_EQ(texture.image.size(), (Size{50, 38}));
}

TEST_P(Interrupted, ACheckpointOfAnotherSynthesisIsNotUsed) {
  NeuralParams params = quick();
  params.optimizer = {GetParam()};
  const Image exemplar = stripes({40, 40}, 3);
  const Target target{{40, 40}, Tile::both};
  const fs::path checkpoint =
      fs::path(testing::TempDir()) / fmt::format("other_{}.checkpoint", to_word(GetParam()));
  Trace first, second;
  synthesise(params, {{{exemplar}}, target, Random(1)}, first.control(5, checkpoint, "seed 1"));
  ASSERT_TRUE(fs::exists(checkpoint));
  synthesise(params, {{{exemplar}}, target, Random(2)}, second.control(-1, checkpoint, "seed 2"));
  EXPECT_EQ(second.steps.front().step, 1);
  fs::remove(checkpoint);
}

// Patches and the other terms of a picture, no network.
TEST(Neural, LevelsByTheCoarsestSide) {
  NeuralParams params;
  params.layout = Layout::noise;
  params.levels = 0;
  params.level_factor = 0.5;
  params.coarsest_side = 32;
  EXPECT_EQ(neural::level_count(params, {256, 256}, {{256, 256}, Tile::both}),
            4);  // 256, 128, 64, 32
  EXPECT_EQ(neural::level_count(params, {300, 120}, {{256, 256}, Tile::both}),
            2);  // the shorter side: 120, 60
  EXPECT_EQ(neural::level_count(params, {20, 20}, {{256, 256}, Tile::both}), 1);
  params.coarsest_side = 33;
  EXPECT_EQ(neural::level_count(params, {256, 256}, {{256, 256}, Tile::both}), 3);
  params.levels = 7;
  EXPECT_EQ(neural::level_count(params, {256, 256}, {{256, 256}, Tile::both}), 7);
}

TEST(Neural, ListsAreReadFromTheFinestLevel) {
  NeuralParams params = quick_patches();
  params.levels = 4;
  params.iterations = {5, 3};
  params.optimizer = {Optimizer::lbfgs, Optimizer::adam};
  EXPECT_EQ(neural::steps_down_to(params, 4, 0), 5 + 3 * 3);
  EXPECT_EQ(neural::steps_down_to(params, 4, 1), 3 * 3);
  Trace trace;
  synthesise(params, {{{stripes({60, 60}, 1)}}, {{60, 60}, Tile::both}, Random(1)},
             trace.control());
  ASSERT_GT(trace.steps.size(), 9u);
  // One evaluation for each step of Adam; L-BFGS begins with two.
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(trace.steps[i].evaluations, trace.steps[i].step);
  EXPECT_GE(trace.steps[9].evaluations, 11);
}

TEST(Neural, LevelsWithoutStepsAreSkipped) {
  NeuralParams params = quick_patches();
  params.iterations = {4, 0, 3};
  Trace trace;
  const Texture texture = synthesise(
      params, {{{stripes({60, 60}, 3)}}, {{50, 40}, Tile::both}, Random(1)}, trace.control());
  EXPECT_EQ(texture.image.size(), (Size{50, 40}));
  EXPECT_EQ(trace.steps.size(), 7u);
}

TEST(Neural, SettingsThatCannotBeAreMistakesOfTheConfig) {
  const auto complaint = [](auto&& change) -> std::string {
    NeuralParams params;
    change(params);
    const Image exemplar = stripes({40, 40}, 3);
    try {
      estimate(params, {{{exemplar.size(), 3}}, {40, 40}, Tile::both});
    } catch (const ConfigError& error) {
      EXPECT_THROW(run(params, exemplar, {{40, 40}, Tile::both}), ConfigError);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint([](auto& p) { p.iterations.clear(); }), "iterations is an empty list");
  EXPECT_EQ(complaint([](auto& p) { p.optimizer.clear(); }), "optimizer is an empty list");
  EXPECT_EQ(complaint([](auto& p) { p.patch_sizes.clear(); }), "patch_sizes is an empty list");
  EXPECT_EQ(
      complaint([](auto& p) { p.sliced_weight = p.spectrum_weight = 0; }),
      "there is nothing to match: sliced_weight, gram_weight and the other weights are all 0");
  EXPECT_EQ(complaint([](auto& p) {
              p.iterations = {5, -1};
            }),
            "iterations = -1: allowed are 0 to 1000000");
}

TEST(Neural, APyramidHasNoValidEdges) {
  NeuralParams params = with_preset(Preset::gatys);
  params.padding = Padding::valid;
  EXPECT_THROW(estimate(params, {{{{64, 64}, 3}}, {64, 64}, Tile::none}), ConfigError);
  EXPECT_THROW(run(params, stripes({64, 64}, 3), {{64, 64}, Tile::none}), ConfigError);
}

INSTANTIATE_TEST_SUITE_P(Optimisers, Interrupted,
                         testing::Values(Optimizer::lbfgs, Optimizer::adam),
                         [](const auto& test) { return std::string(to_word(test.param)); });

// A picture of 4096² had strips of one brightness along its edges, 40 pixels wide: what is cut off
// grows with the picture, up to what the coarsest levels see of an edge.
TEST(NeuralSynthesis, MoreIsCutOffALargePictureThanASmallOne) {
  NeuralParams params;
  params.patch_sizes = {7, 5};
  const auto margin = [&](int side, Tile tile) {
    const Size canvas = neural::canvas_size(params, {{side, side}, tile});
    return std::pair((canvas.width - side) / 2, (canvas.height - side) / 2);
  };
  EXPECT_EQ(margin(256, Tile::none), std::pair(7, 7));
  EXPECT_EQ(margin(1000, Tile::none), std::pair(25, 25));
  EXPECT_EQ(margin(4096, Tile::none), std::pair(56, 56));
  EXPECT_EQ(margin(4096, Tile::x), std::pair(0, 56));
  EXPECT_EQ(margin(4096, Tile::both), std::pair(0, 0));
}

}  // namespace
}  // namespace gramloom
