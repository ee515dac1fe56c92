#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/error.h"
#include "core/hash.h"
#include "core/random.h"
#include "learnt/inference_model.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A model that has learnt nothing.
InferenceModel some_inference(Tile wraps = Tile::none) {
  InferenceModel model;
  InferenceDescription& description = model.description;
  description.pose = {{"bend", 0, 90}, {"twist", -30, 30}};
  description.size = {20, 12};
  description.channels = 2;
  description.wraps = wraps;
  description.pose_hidden = 6;
  description.hidden = {8, 4};
  description.errors = {100, 9, 8, 0.125, 0.5, 0.25};
  Random random(1);
  for (const auto& [name, shape] : tensor_shapes(description)) {
    std::int64_t count = 1;
    for (const std::int64_t length : shape) count *= length;
    TensorData& tensor = model.tensors[name] = {shape, {}};
    for (std::int64_t i = 0; i < count; ++i) tensor.values.push_back(0.3f * random.normal());
  }
  model.tensors["pictures.low"].values = {-9, -9};
  model.tensors["pictures.high"].values = {9, 0.1f};
  return model;
}

class InferenceFile : public testing::Test {
 protected:
  ~InferenceFile() override { fs::remove(file_); }

  std::string refusal() const {
    try {
      read_inference(file_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const fs::path file_ =
      fs::temp_directory_path() / fmt::format("gramloom_inference_{}.safetensors", getpid());
};

TEST_F(InferenceFile, ComesBack) {
  const InferenceModel model = some_inference(Tile::x);
  write_inference(file_, model, {{"identity", "i"}});
  const InferenceModel read = read_inference(file_);
  EXPECT_EQ(read.tensors, model.tensors);
  EXPECT_EQ(to_json_value(read.description), to_json_value(model.description));
  EXPECT_EQ(read.description.pose, model.description.pose);
  EXPECT_EQ(infer(read, {30, 5}), infer(model, {30, 5}));
}

TEST_F(InferenceFile, WhatDoesNotFitIsRefusedInOneLine) {
  const auto refused = [&](const std::function<void(InferenceModel&)>& change) {
    InferenceModel model = some_inference();
    change(model);
    write_inference(file_, model);
    return refusal();
  };
  EXPECT_THAT(refused([](auto& m) { m.description.channels = 1; }), HasSubstr("is of shape"));
  EXPECT_THAT(refused([](auto& m) { m.tensors.erase("out.bias"); }),
              HasSubstr("lacks the tensor 'out.bias'"));
  EXPECT_THAT(refused([](auto& m) {
                m.tensors["out.bias"].values[0] = std::numeric_limits<float>::quiet_NaN();
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(refused([](auto& m) { m.description.kind = "generator"; }),
              HasSubstr("is a model of kind 'generator', needed is 'inference'"));
  EXPECT_THAT(refused([](auto& m) { m.description.pose.clear(); }), HasSubstr("1 to 256 numbers"));
  EXPECT_THAT(refused([](auto& m) { m.description.pose[0].high = -1; }),
              HasSubstr("the range of 'bend'"));
  EXPECT_THAT(refused([](auto& m) { m.description.hidden.clear(); }), HasSubstr("1 to 10 sizes"));
  write_tensors(file_, some_inference().tensors, {});
  EXPECT_THAT(refusal(), HasSubstr("is no model that gramloom trained"));
  write_tensors(file_, some_inference().tensors,
                {{"gramloom", "{\"version\": 2, \"kind\": \"inference\"}"}});
  EXPECT_THAT(refusal(), HasSubstr("is of kind inference and version 2"));
}

TEST(Inference, PosesAreChecked) {
  const InferenceDescription description = some_inference().description;
  const auto refusal = [&](const std::vector<double>& pose, bool extrapolates = false) {
    try {
      check_pose(description.pose, pose, extrapolates);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal({0, 30}), "");
  EXPECT_EQ(refusal({1, 2, 3}), "a pose of 3 numbers, the model's has 2: bend, twist");
  EXPECT_EQ(refusal({120, 0}), "bend = 120: learnt are 0 to 90 (extrapolate allows others)");
  EXPECT_EQ(refusal({120, 0}, true), "");
  EXPECT_EQ(refusal({std::nan(""), 0}, true), "bend = nan is no number");
}

// The same on every machine: this hash is that of ours.
TEST(Inference, HasTheSameBytesOnEveryMachine) {
  const Image picture = infer(some_inference(Tile::x), {30, 5});
  EXPECT_EQ(picture.size(), (Size{20, 12}));
  Fnv1a hash;
  hash.add(picture.pixels.data(), picture.pixels.size() * sizeof(float));
  EXPECT_EQ(hash.text(), "4f0d6381bcd97e60");
}

TEST(Inference, StaysInTheRangeThatItLearnt) {
  const ChannelRange range = channel_range(infer(some_inference(), {90, 30}));
  EXPECT_EQ(range.high[1], 0.1f);
  EXPECT_GT(range.high[0], 0.1f);
}

TEST(Inference, ANumberThatNeverChangedIsAsIfItWere) {
  InferenceModel model = some_inference();
  model.description.pose[1] = {"twist", 7, 7};
  EXPECT_EQ(infer(model, {30, 7}), infer(model, {30, 8}));
}

// With the same values all around, what wraps knows no edge: a start that is moved moves the
// picture.
TEST(Inference, WrapsWithoutASeam) {
  InferenceModel model = some_inference(Tile::x);
  model.tensors["pictures.mean"].values.assign(2 * 20 * 12, 0.0f);
  model.tensors["pictures.high"].values = {9, 9};
  model.tensors["start.weight"].values.assign(model.values("start.weight").size(), 0.0f);
  const Image before = infer(model, {30, 5});
  std::vector<float>& start = model.tensors["start.bias"].values;  // of 8 channels of 10×6
  for (std::size_t row = 0; row < start.size(); row += 10)
    std::rotate(start.begin() + static_cast<std::ptrdiff_t>(row),
                start.begin() + static_cast<std::ptrdiff_t>(row) + 3,
                start.begin() + static_cast<std::ptrdiff_t>(row) + 10);
  const Image moved = infer(model, {30, 5});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_EQ(moved.at(x, y)[0], before.at((x + 6) % 20, y)[0]);
}

}  // namespace
}  // namespace gramloom
