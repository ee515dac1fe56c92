#include "learnt/generator_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "core/error.h"
#include "io/text_file.h"
#include "learnt/model_file.h"
#include "learnt/some_generator.h"

namespace gramloom {
namespace {

GeneratorModel three_levels(int materials = 1, int channels = 3) {
  return some_generator({{8, 16, 3}, {4, 24, 2}, {4, 8, 1}}, channels, materials);
}

using testing::HasSubstr;
using testing::ThrowsMessage;

class GeneratorFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  void expect_refused(const std::string& why) const {
    EXPECT_THAT([&] { read_generator(file_); },
                ThrowsMessage<Error>(testing::AllOf(HasSubstr(file_.string()), HasSubstr(why),
                                                    testing::Not(HasSubstr("\n")))));
  }
  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() /
      fmt::format("{}.safetensors", testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GeneratorFile, ComesBackAsItWas) {
  GeneratorModel model = three_levels(2, 4);
  model.description.materials[1] = {"moss", "0123", "CC0"};
  model.description.recipe = {{"steps", 3}};
  write_generator(file_, model);
  const GeneratorModel read = read_generator(file_);
  EXPECT_EQ(read.tensors, model.tensors);
  EXPECT_EQ(to_text(to_json_value(read.description)), to_text(to_json_value(model.description)));
  EXPECT_EQ(model_kind(file_), "generator");
}

TEST_F(GeneratorFile, OfANewerVersion) {
  const GeneratorModel model = three_levels();
  Json json{{"version", 99}};
  json.update(to_json_value(model.description));
  write_tensors(file_, model.tensors, {{"gramloom", to_text(json)}});
  expect_refused("is of kind generator and version 99");
}

TEST_F(GeneratorFile, OfAnotherKind) {
  write_tensors(file_, {}, {{"gramloom", R"({"version": 1, "kind": "inference"})"}});
  expect_refused("is a model of kind 'inference', needed is 'generator'");
}

TEST_F(GeneratorFile, ThatIsNone) {
  write_tensors(file_, {});
  expect_refused("is no model that gramloom trained");
  write_text(file_, "not a model");
  EXPECT_THROW(read_generator(file_), Error);
}

TEST_F(GeneratorFile, WithANumberThatIsNone) {
  GeneratorModel model = three_levels();
  model.tensors["levels.1.out.bias"].values[0] = std::numeric_limits<float>::quiet_NaN();
  write_generator(file_, model);
  expect_refused("'levels.1.out.bias' holds a value that is not finite");
}

TEST_F(GeneratorFile, OfOtherChannels) {
  GeneratorModel model = three_levels();
  model.description.channels = 1;
  model.description.layers[0].count = 1;
  write_generator(file_, model);
  expect_refused("its description says");
}

TEST_F(GeneratorFile, ThatLacksATensor) {
  GeneratorModel model = three_levels();
  model.tensors.erase("levels.0.layers.1.bias");
  write_generator(file_, model);
  expect_refused("lacks the tensor 'levels.0.layers.1.bias'");
}

}  // namespace
}  // namespace gramloom
