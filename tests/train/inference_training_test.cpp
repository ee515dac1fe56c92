#include "train/inference_training.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/torch.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/random.h"
#include "train/inference_net.h"

namespace gramloom {
namespace {

constexpr int side = 16;

// Wrinkles that turn, move and grow with the pose, and wrap in x.
Image wrinkles(const std::vector<double>& pose) {
  Image picture(side, side, 1);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double u = 2 * M_PI * x / side, v = 2.0 * y / side - 1;
      const double crease = v - 0.4 * pose[0] - 0.2 * std::sin(u + pose[1]);
      picture.at(x, y)[0] =
          static_cast<float>((1 + 0.5 * pose[1]) * std::exp(-6 * crease * crease) *
                             std::cos((5 + 2 * pose[0]) * crease + std::cos(u)));
    }
  return picture;
}

std::vector<std::vector<double>> poses(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<double>> all;
  for (int i = 0; i < count; ++i)
    all.push_back({random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f)});
  return all;
}

InferenceLesson lesson(int pairs, int steps) {
  InferenceLesson lesson;
  lesson.recipe.pose_hidden = 24;
  lesson.recipe.hidden = {12, 8};
  lesson.recipe.batch = 8;
  lesson.recipe.steps = steps;
  lesson.recipe.sample_every = 10;
  lesson.description.pose = {{"bend", -1, 1}, {"twist", -1, 1}};
  lesson.poses = poses(pairs, 1);
  for (const auto& pose : lesson.poses) lesson.pictures.push_back(wrinkles(pose));
  return lesson;
}

double squared_distance(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(static_cast<double>(a.pixels[i] - b.pixels[i]), 2);
  return sum;
}

TEST(InferenceTraining, BeatsTheNearestPictureOnPosesThatItHasNotSeen) {
  InferenceLesson task = lesson(60, 300);
  task.recipe.sample_every = 100;
  const InferenceModel model = train_inference(task, {}, {});
  double inferred = 0, nearest = 0;
  for (const auto& pose : poses(40, 2)) {
    const Image real = wrinkles(pose);
    inferred += squared_distance(infer(model, pose), real);
    std::size_t best = 0;
    const auto distance = [&](std::size_t i) {
      return std::hypot(task.poses[i][0] - pose[0], task.poses[i][1] - pose[1]);
    };
    for (std::size_t i = 1; i < task.poses.size(); ++i)
      if (distance(i) < distance(best)) best = i;
    nearest += squared_distance(task.pictures[best], real);
  }
  EXPECT_LT(std::sqrt(inferred / nearest), 0.7);
}

TEST(InferenceTraining, GoesOnToTheSameBytes) {
  const InferenceLesson task = lesson(10, 35);
  // The third of four looks is the best.
  const InferenceJudge judge = [](const InferenceState& state) {
    return std::abs(state.step - 30);
  };
  const InferenceModel whole = train_inference(task, {}, judge);
  for (const int stop : {7, 20, 31}) {
    const auto file = std::filesystem::temp_directory_path() / "inference_test.checkpoint";
    std::filesystem::remove(file);
    Control control;
    control.checkpoint = file;
    control.identity = "a";
    control.progress = [&](const Progress& progress) { return progress.step < stop; };
    EXPECT_THROW(train_inference(task, control, judge), Interrupted);
    std::int64_t first = -1;
    control.progress = [&](const Progress& progress) {
      if (first < 0) first = progress.step;
      return true;
    };
    const InferenceModel resumed = train_inference(task, control, judge);
    EXPECT_EQ(first, stop + 1);
    EXPECT_EQ(resumed.tensors, whole.tensors) << stop;
    // The state of other work is not gone on from.
    control.identity = "b";
    first = -1;
    EXPECT_EQ(train_inference(task, control, judge).tensors, whole.tensors);
    EXPECT_EQ(first, 1);
    std::filesystem::remove(file);
  }
}

TEST(InferenceTraining, KeepsTheBestState) {
  const InferenceLesson task = lesson(10, 30);
  std::vector<InferenceModel> states;
  const InferenceModel model = train_inference(task, {}, [&](const InferenceState& state) {
    states.push_back(state.model);
    return std::abs(state.step - 20);
  });
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(model.tensors, states[1].tensors);
  EXPECT_NE(model.tensors, states[2].tensors);
}

TEST(InferenceTraining, TellsWhichAxesWrap) {
  const InferenceLesson task = lesson(10, 1);
  EXPECT_TRUE(tiles_x(wrapping_axes(task.pictures)));
  Image ramp(side, side, 2);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) ramp.at(x, y)[1] = static_cast<float>(x + 2 * y);
  EXPECT_EQ(wrapping_axes({ramp}), Tile::none);
  EXPECT_EQ(wrapping_axes({Image(side, side, 1)}), Tile::both) << "nothing speaks against it";
}

TEST(InferenceTraining, RefusesARecipeThatCannotBe) {
  InferenceLesson task = lesson(10, 1);
  task.recipe.hidden = {};
  EXPECT_THAT([&] { train_inference(task, {}, {}); },
              testing::ThrowsMessage<ConfigError>("hidden has 0 numbers: allowed are 1 to 10"));
}

// What LibTorch trains is what learnt/ computes, whatever the sizes and edges.
TEST(InferenceTraining, TrainsTheNetworkThatInfers) {
  for (const Tile wraps : {Tile::none, Tile::x, Tile::both})
    for (const Size size : {Size{16, 16}, Size{13, 10}}) {
      InferenceDescription description;
      description.pose = {{"a", -1, 1}, {"b", 0, 2}};
      description.size = size;
      description.channels = 2;
      description.wraps = wraps;
      description.pose_hidden = 6;
      description.hidden = {8, 4, 6};
      torch::manual_seed(4);
      train::InferenceNet net(description);
      const torch::NoGradGuard no_gradients;
      InferenceModel model{description, {}};
      for (const auto& item : net->named_parameters()) {
        if (item.key().ends_with("bias")) item.value().normal_(0, 0.3);
        const at::Tensor values = item.value().contiguous();
        model.tensors[item.key()] = {
            values.sizes().vec(),
            {values.data_ptr<float>(), values.data_ptr<float>() + values.numel()}};
      }
      const auto pixels = static_cast<std::size_t>(size.width * size.height);
      model.tensors["pictures.mean"] = {{2, size.height, size.width},
                                        std::vector<float>(2 * pixels, 0.25f)};
      model.tensors["pictures.deviation"] = {{2}, {2, 3}};
      model.tensors["pictures.low"] = {{2}, {-100, -100}};
      model.tensors["pictures.high"] = {{2}, {100, 100}};
      EXPECT_EQ(model.tensors.size(), tensor_shapes(description).size());
      const Image picture = infer(model, {0.5, 0.3});
      const at::Tensor made = net->forward(torch::tensor({{0.5f, -0.7f}}));
      ASSERT_EQ(made.size(2), size.height);
      ASSERT_EQ(made.size(3), size.width);
      for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
          for (int c = 0; c < 2; ++c)
            EXPECT_NEAR(picture.at(x, y)[c],
                        0.25f + static_cast<float>(c + 2) * made[0][c][y][x].item<float>(), 2e-5);
    }
}

TEST(InferenceTraining, GradientsAreThoseOfFiniteDifferences) {
  for (const Tile wraps : {Tile::none, Tile::x}) {
    InferenceDescription description;
    description.pose = {{"a", -1, 1}, {"b", -1, 1}};
    description.size = {7, 6};
    description.wraps = wraps;
    description.pose_hidden = 5;
    description.hidden = {4, 5};
    torch::manual_seed(2);
    train::InferenceNet net(description);
    net->to(torch::kDouble);
    const at::Tensor inputs = at::randn({3, 2}, at::kDouble),
                     real = at::randn({3, 1, 6, 7}, at::kDouble);
    const auto loss = [&] {
      const train::InferenceLoss terms = train::inference_loss(net->forward(inputs), real, wraps);
      return terms.values + 0.5 * terms.slopes;
    };
    loss().backward();
    for (const auto& item : net->named_parameters()) {
      at::Tensor flat = item.value().detach().view({-1});
      const at::Tensor gradient = item.value().grad().view({-1});
      for (const std::int64_t i : {std::int64_t{0}, flat.numel() / 2, flat.numel() - 1}) {
        const double before = flat[i].item<double>(), step = 1e-5;
        flat[i] = before + step;
        const double more = loss().item<double>();
        flat[i] = before - step;
        const double less = loss().item<double>();
        flat[i] = before;
        EXPECT_NEAR(gradient[i].item<double>(), (more - less) / (2 * step), 1e-7)
            << item.key() << " " << i;
      }
    }
  }
}

// Of a difference d that is 1 in one pixel and 0 elsewhere.
TEST(InferenceTraining, SlopesCountAroundTheEdgesThatWrap) {
  at::Tensor made = at::zeros({1, 1, 4, 5});
  made[0][0][2][0] = 1;
  const at::Tensor real = at::zeros({1, 1, 4, 5});
  const auto flat = train::inference_loss(made, real, Tile::none);
  EXPECT_FLOAT_EQ(flat.values.item<float>(), 1 / 20.0f);
  EXPECT_FLOAT_EQ(flat.slopes.item<float>(), 2 / 15.0f + 1 / 16.0f);
  const auto wrapped = train::inference_loss(made, real, Tile::x);
  EXPECT_FLOAT_EQ(wrapped.slopes.item<float>(), 2 / 15.0f + 2 / 20.0f);
}

}  // namespace
}  // namespace gramloom
