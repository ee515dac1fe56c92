#pragma once

#include <filesystem>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// How a network is trained that infers a picture from a few numbers, such as the displacement of a
/// sleeve from the angles of an arm: a [[model]] of a config (learnt/inference_model.h).
struct InferenceRecipe {
  static constexpr std::string_view kind = "inference";
  static constexpr std::string_view summary = "a small network that infers a picture from a pose";

  std::filesystem::path pairs;
  std::filesystem::path simulation;
  double held_out = 0.15;
  int pose_hidden = 128;
  std::vector<int> hidden{64, 48, 32, 16};
  int steps = 2500;
  int batch = 16;
  double learning_rate = 0.003;
  double slopes = 0.5;
  int sample_every = 500;
  int seed = 1;

  static constexpr auto fields() {
    using R = InferenceRecipe;
    return std::tuple{
        Field{
            "pairs", &R::pairs,
            "a CSV table: the column 'picture' names a file beside it, all others are numbers, the "
            "pose"},
        Field{
            "simulation", &R::simulation,
            "or a simulation's file, as `gramloom simulate` reads it: its pictures are made first"},
        Field{
            "held_out", &R::held_out, "of the pairs are kept for the error", "share", {0.01, 0.5}},
        Field{"pose_hidden", &R::pose_hidden, "values that the pose becomes first", "", {4, 1024}},
        Field{"hidden",
              &R::hidden,
              "channels at each size, the smallest first: each is twice as large",
              "",
              {4, 256}},
        Field{"steps", &R::steps, "of training", "", {1, 1e6}},
        Field{"batch", &R::batch, "pairs a step", "", {1, 1024}},
        Field{"learning_rate", &R::learning_rate, "of Adam, at most", "", {1e-6, 1}},
        Field{"slopes",
              &R::slopes,
              "weight of the difference of slopes beside that of values",
              "",
              {0, 100}},
        Field{"sample_every", &R::sample_every, "steps between two looks", "", {1, 1e6}},
        Field{"seed", &R::seed, "of the training's random numbers", "", {0, 2147483647}},
    };
  }
};

}  // namespace gramloom
