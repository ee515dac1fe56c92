// Syntheses by patches along random directions. Those by a network are in synthesis_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/threads.h"
#include "neural/layout.h"
#include "neural/picture.h"
#include "neural/resample.h"
#include "syntheses.h"
#include "tensors.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

TEST(NeuralPatches, ThreadsDoNotMatter) {
  const Image exemplar = stripes({72, 64}, 3);
  const Target target{{80, 72}, Tile::x};
  for (const int positions : {300'000, 4096}) {  // all, and a part of those of the finest level
    NeuralParams params = quick_patches();
    params.positions = positions;
    const Image whole = run(params, exemplar, target);
    set_thread_count(1);
    const Image alone = run(params, exemplar, target);
    set_thread_count(0);
    EXPECT_EQ(alone, whole);
  }
}

TEST(NeuralPatches, GoOnToTheSameBytes) {
  for (const auto& optimisers : {std::vector{Optimizer::adam},
                                 {Optimizer::lbfgs, Optimizer::adam},
                                 {Optimizer::adam, Optimizer::lbfgs}}) {
    NeuralParams params = quick_patches();
    params.optimizer = optimisers;
    params.positions = 4096;  // the finest level looks at a part of them
    const Image exemplar = stripes({48, 48}, 3);
    const Target target{{64, 72}, Tile::both};
    const fs::path checkpoint = fs::path(testing::TempDir()) / "neural_patches.checkpoint";
    fs::remove(checkpoint);
    const Image whole = run(params, exemplar, target);
    for (const std::int64_t stop : {1, 3, 4, 5, 9, 10, 14, 15}) {  // levels end at 4, 9 and 15
      Trace first, second;
      synthesise(params, {{{exemplar}}, target, Random(1)}, first.control(stop, checkpoint));
      EXPECT_EQ(first.steps.back().step, stop);
      ASSERT_TRUE(fs::exists(checkpoint));
      const Image resumed =
          synthesise(params, {{{exemplar}}, target, Random(1)}, second.control(-1, checkpoint))
              .image;
      EXPECT_EQ(resumed, whole) << "stopped at " << stop;
      fs::remove(checkpoint);
    }
  }
}

TEST(NeuralPatches, ReportsEachStepWithItsTerms) {
  NeuralParams params = quick_patches();
  params.gram_weight = 0.5;
  params.network = "vgg_small";
  params.layers = {"relu1_1", "pool1"};
  params.autocorrelation_weight = 0.2;
  params.variation_weight = 0.3;
  Trace trace;
  synthesise(params, {{{stripes({64, 64}, 3)}}, {{48, 40}, Tile::none}, Random(1)},
             trace.control());
  ASSERT_EQ(trace.steps.size(), 15u);
  for (const auto& p : trace.steps) {
    std::vector<std::string> names;
    double sum = 0;
    for (const auto& term : p.terms) {
      names.push_back(term.name);
      sum += term.value;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"gram_relu1_1", "gram_pool1", "sliced", "spectrum",
                                               "autocorrelation", "variation"}));
    EXPECT_NEAR(sum, p.loss, 1e-5 * p.loss);
    EXPECT_EQ(p.steps, 15);
  }
}

TEST(NeuralPatches, WeightsCountOnceEach) {
  // Twice the weight is twice the first loss.
  NeuralParams params = quick_patches();
  params.iterations = {1};
  params.levels = 1;
  params.autocorrelation_weight = 0.2;
  params.variation_weight = 0.3;
  const auto terms = [&] {
    Trace trace;
    synthesise(params, {{{stripes({40, 40}, 3)}}, {{40, 40}, Tile::both}, Random(1)},
               trace.control());
    return trace.steps.at(0).terms;
  };
  const auto once = terms();
  params.sliced_weight *= 2;
  params.spectrum_weight *= 2;
  params.autocorrelation_weight *= 2;
  params.variation_weight *= 2;
  const auto twice = terms();
  ASSERT_EQ(once.size(), 4u);
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_DOUBLE_EQ(twice[i].value, 2 * once[i].value) << once[i].name;
}

// A few large blobs of colour: no texture, so that its patches fit together in one way only.
Image scene(Size size) {
  const at::Tensor coarse = neural::numbers({3, 6, 6}, 11) * 0.2 + 0.5;
  return neural::to_image(neural::resample(coarse, size, Tile::none));
}

struct Layout {
  double copied = 0;
  std::size_t steps = 0;
};
Layout layout_of_result(const Image& exemplar, double copy_limit) {
  NeuralParams params;
  params.layout = gramloom::Layout::noise;
  params.iterations = {2, 10, 30, 250};
  params.copy_limit = copy_limit;
  Trace trace;
  const Image result =
      synthesise(params, {{{exemplar}}, {{128, 128}, Tile::none}, Random(1)}, trace.control())
          .image;
  const auto small = [](const Image& image) {
    return neural::resample(neural::to_planes(image), {32, 32}, Tile::none);
  };
  return {neural::layout_copied(small(result), small(exemplar), Tile::none), trace.steps.size()};
}

TEST(NeuralPatches, LeaveOutALevelThatBringsBackTheLayout) {
  const Image exemplar = scene({128, 128});
  const Layout any = layout_of_result(exemplar, 2), limited = layout_of_result(exemplar, 0.15);
  EXPECT_GT(any.copied, 0.2);
  EXPECT_LT(limited.copied, any.copied - 0.1);
  EXPECT_EQ(limited.steps, any.steps);
}

// Stopped on the last step of the level that is left out, and on the first one after it.
TEST(NeuralPatches, LeaveItOutAlsoWhenInterruptedThere) {
  const Image exemplar = scene({128, 128});
  NeuralParams params;
  params.layout = gramloom::Layout::noise;
  params.iterations = {2, 3, 4, 10, 250};
  const Target target{{128, 128}, Tile::none};
  Trace whole;
  const Image expected =
      synthesise(params, {{{exemplar}}, target, Random(1)}, whole.control()).image;
  for (const std::int64_t stop : {250, 251}) {
    const fs::path file = fs::path(testing::TempDir()) / "left_out.checkpoint";
    fs::remove(file);
    Trace first, second;
    synthesise(params, {{{exemplar}}, target, Random(1)}, first.control(stop, file));
    EXPECT_EQ(first.steps.size(), static_cast<std::size_t>(stop));
    EXPECT_EQ(synthesise(params, {{{exemplar}}, target, Random(1)}, second.control(-1, file)).image,
              expected)
        << stop;
    EXPECT_EQ(first.steps.size() + second.steps.size(), whole.steps.size());
    fs::remove(file);
  }
}

// Nor of a result smaller than the exemplar, which is like some place of it.
TEST(NeuralPatches, KeepAllLevelsOfASmallResult) {
  NeuralParams params;
  params.layout = gramloom::Layout::noise;
  params.iterations = {1, 2, 5, 60};
  const Image exemplar = scene({128, 128});
  const Target target{{64, 64}, Tile::both};
  const Image kept = run(params, exemplar, target);
  params.copy_limit = 2;
  EXPECT_EQ(kept, run(params, exemplar, target));
}

TEST(NeuralPatches, KeepAllLevelsOfATexture) {
  NeuralParams params;
  params.layout = gramloom::Layout::noise;
  params.iterations = {1, 5, 10, 100};
  const Image exemplar = neural::to_image(
      neural::resample(neural::numbers({3, 40, 40}, 5) * 0.2 + 0.5, {128, 128}, Tile::none));
  const Target target{{128, 128}, Tile::both};
  const Image kept = run(params, exemplar, target);
  params.copy_limit = 2;
  EXPECT_EQ(kept, run(params, exemplar, target));
}

TEST(Neural, APatchLargerThanTheExemplarIsAClearError) {
  NeuralParams params = quick_patches();
  params.levels = 2;
  params.level_factor = 0.5;
  params.patch_sizes = {13};
  try {
    run(params, stripes({24, 40}, 3), {{64, 64}, Tile::both});
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "the exemplar of 12×20 is too small for patches of 13×13: make patch_sizes smaller");
  }
}

}  // namespace
}  // namespace gramloom
