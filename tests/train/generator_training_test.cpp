#include "train/generator_training.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <torch/torch.h>

#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/threads.h"
#include "learnt/generator.h"
#include "learnt/noise.h"
#include "train/networks.h"
#include "train/patch_loss.h"

namespace gramloom {
namespace {

// Bright spots on a dark ground.
Image spots(int side, double pitch) {
  Image image(side, side, 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double value = std::sin(x * pitch) * std::sin(y * pitch);
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<float>(0.5 + 0.4 * value - 0.05 * c * value);
    }
  return image;
}

GeneratorLesson lesson(int materials = 1) {
  GeneratorLesson lesson;
  lesson.recipe.coarsest_side = 32;
  lesson.recipe.hidden = {8};
  lesson.recipe.layers = {2};
  lesson.recipe.noise = {4};
  lesson.recipe.steps = {12, 8};
  lesson.recipe.batch = {2, 1};
  lesson.recipe.crop = {48};
  lesson.recipe.directions = 8;
  lesson.recipe.adversary_hidden = {4};
  lesson.recipe.adversary_layers = {2};
  lesson.recipe.sample_every = 5;
  lesson.description.layers = {{"", MapKind::colour, 0, 3, GreenAxis::up}};
  for (int m = 0; m < materials; ++m) {
    lesson.exemplars.push_back(spots(64, m == 0 ? 0.5 : 1.1));
    lesson.description.materials.push_back({std::string(1, static_cast<char>('a' + m)), "", ""});
  }
  return lesson;
}

double never(const TrainingState&) { return 1; }

TEST(GeneratorTraining, LowersADistanceThatItDoesNotSee) {
  // The fourth moment of differences of neighbours.
  const auto roughness = [](const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 1; x < image.width; ++x)
        sum += std::pow(image.at(x, y)[0] - image.at(x - 1, y)[0], 4);
    return std::log(sum / (image.height * (image.width - 1.0)) + 1e-12);
  };
  GeneratorLesson task = lesson();
  task.recipe.steps = {60, 50};
  const double goal = roughness(task.exemplars.front());
  std::vector<double> scores;
  const GeneratorModel model = train_generator(task, {}, [&](const TrainingState& state) {
    if (state.levels_to_come > 0) return 1e9;
    const Image made = generate(state.model, {{64, 64}, Tile::both, 1, {1}, {}}, {});
    scores.push_back(std::abs(roughness(made) - goal));
    return scores.back();
  });
  ASSERT_GT(scores.size(), 3u);
  EXPECT_LT(*std::min_element(scores.begin(), scores.end()), 0.5 * scores.front() + 0.2);
  // The best state is the one that is kept.
  const Image kept = generate(model, {{64, 64}, Tile::both, 1, {1}, {}}, {});
  EXPECT_NEAR(std::abs(roughness(kept) - goal), *std::min_element(scores.begin(), scores.end()),
              1e-3);
}

TEST(GeneratorTraining, GoesOnToTheSameBytes) {
  for (const int materials : {1, 2}) {
    const GeneratorLesson task = lesson(materials);
    const GeneratorModel whole = train_generator(task, {}, never);
    for (const int stop : {5, 12, 15}) {
      const auto file = std::filesystem::temp_directory_path() / "training_test.checkpoint";
      std::filesystem::remove(file);
      Control control;
      control.checkpoint = file;
      control.identity = "a";
      control.progress = [&](const Progress& progress) { return progress.step < stop; };
      EXPECT_THROW(train_generator(task, control, never), Interrupted);
      std::int64_t first = -1;
      control.progress = [&](const Progress& progress) {
        if (first < 0) first = progress.step;
        return true;
      };
      const GeneratorModel resumed = train_generator(task, control, never);
      EXPECT_EQ(first, stop + 1);
      EXPECT_TRUE(resumed.tensors == whole.tensors) << stop;
      std::filesystem::remove(file);
    }
  }
}

TEST(GeneratorTraining, RefusesAnExemplarThatIsTooSmall) {
  GeneratorLesson task = lesson();
  task.exemplars = {spots(6, 0.5)};
  EXPECT_THAT([&] { train_generator(task, {}, never); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("too small")));
}

// What LibTorch trains is what learnt/ computes.
TEST(GeneratorTraining, TrainsTheNetworksThatGenerate) {
  for (const int materials : {1, 2}) {
    GeneratorLesson task = lesson(materials);
    task.recipe.hidden = {8, 16};
    task.recipe.layers = {3, 2};
    GeneratorModel model = train_generator(task, {}, never);
    const std::vector<float> shares =
        materials == 1 ? std::vector<float>{1} : std::vector<float>{0.4f, 0.6f};
    const Image image = generate(model, {{32, 32}, Tile::both, 3, shares, {}}, {});
    const torch::NoGradGuard no_gradients;
    at::Tensor picture, coarser;
    for (int k = 0; k < 2; ++k) {
      train::LevelNet net(model.description, k);
      for (const auto& item : net->named_parameters()) {
        const TensorData& data = model.tensors.at(fmt::format("levels.{}.{}", k, item.key()));
        item.value().copy_(at::from_blob(const_cast<float*>(data.values.data()),
                                         item.value().sizes(), at::kFloat));
      }
      const int side = 16 << k;
      at::Tensor noise = at::empty({1, 4, side, side});
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const auto words = pcg4d(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 3,
                                   static_cast<std::uint32_t>(k * noise_groups_per_level));
          for (int c = 0; c < 4; ++c)
            noise[0][c][y][x] = noise_value(words[static_cast<std::size_t>(c)]);
        }
      if (k > 0) coarser = train::upsampled(picture, train::Border::wraps);
      picture = net->forward(coarser, noise,
                             torch::tensor(std::vector<float>(shares.begin(), shares.end())),
                             train::Border::wraps);
    }
    float largest = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        for (int c = 0; c < 3; ++c) {
          float sum = model.values("colours.mean")[static_cast<std::size_t>(c)];
          for (int i = 0; i < 3; ++i)
            sum += model.values("colours.axes")[static_cast<std::size_t>(3 * c + i)] *
                   picture[0][i][y][x].item<float>();
          sum = std::clamp(sum, model.values("colours.low")[static_cast<std::size_t>(c)],
                           model.values("colours.high")[static_cast<std::size_t>(c)]);
          largest = std::max(largest, std::abs(sum - image.at(x, y)[c]));
        }
    EXPECT_LT(largest, 1e-4);
  }
}

}  // namespace
}  // namespace gramloom
