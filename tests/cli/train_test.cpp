// `gramloom train` and `gramloom generate` from the command line.
#include <gmock/gmock.h>

#include "cli/workspace.h"
#include "learnt/generator_model.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class TrainCommand : public Workspace {
 protected:
  // In one thread, which such small networks are trained fastest by (tests/train/one_thread.cpp).
  Outcome train(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"train", "t.toml", "--threads", "1"});
    return run(more);
  }
  // A training of two levels that takes a second.
  void write_config(const std::string& more = "", const std::string& exemplar = "") {
    Image spots(64, 64, 3), rings(64, 64, 3);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        for (int c = 0; c < 3; ++c) {
          const double u = x * 0.5, v = y * 0.4;
          spots.at(x, y)[c] = static_cast<float>(0.5 + 0.3 * std::sin(u) * std::sin(v) - 0.05 * c);
          rings.at(x, y)[c] = static_cast<float>(0.2 + 0.1 * std::sin(2 * u + v) + 0.05 * c);
        }
    write_image(folder_ / "spots.png", spots, {});
    write_image(folder_ / "rings.png", rings, {});
    write_text(folder_ / "t.toml",
               "size = [64, 64]\ntile = 'both'\n"
               "[[exemplar]]\nname = 'spots'\nimage = 'spots.png'\nlicence = 'CC0'\n" +
                   exemplar +
                   "[[model]]\nname = 'small'\nkind = 'generator'\ncoarsest_side = 32\n"
                   "hidden = [8]\nlayers = [2]\nnoise = [4]\nsteps = [40, 30]\nbatch = [2, 1]\n"
                   "directions = 8\nadversary_hidden = [4]\nadversary_layers = [2]\n"
                   "sample_every = 20\n" +
                   more);
  }
};

TEST_F(TrainCommand, LeavesAModelAndItsTextures) {
  write_config();
  const Outcome outcome = train();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const fs::path out = folder_ / "out/t";
  for (const char* file :
       {"models/spots_small.safetensors", "models/spots_small.csv", "models/spots_small_000020.png",
        "spots/small/seed1.png", "index.html", "scores.csv"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  EXPECT_FALSE(fs::exists(out / "models/spots_small.checkpoint"));
  const GeneratorDescription description =
      read_generator_description(out / "models/spots_small.safetensors");
  EXPECT_EQ(description.materials.at(0).name, "spots");
  EXPECT_EQ(description.materials.at(0).licence, "CC0");
  EXPECT_EQ(description.levels.size(), 2u);
  // It is kept, and its texture made again, by `generate` too.
  const Outcome again = train({"--resume"});
  EXPECT_THAT(again.errors, HasSubstr("trained before"));
  const Outcome generated = run({"generate", "out/t/models/spots_small.safetensors", "--size", "64",
                                 "--tile", "both", "--output", "g.png", "--quiet"});
  ASSERT_EQ(generated.exit_code, 0) << generated.errors;
  EXPECT_EQ(read_image(folder_ / "g.png").image, read_image(out / "spots/small/seed1.png").image);
}

TEST_F(TrainCommand, LearnsAPictureWithAlpha) {
  write_config();
  const Image spots = read_image(folder_ / "spots.png").image;
  Image opaque(spots.size(), 4, 1.0f);
  for (std::size_t i = 0; i < spots.pixels.size(); ++i)
    opaque.pixels[4 * (i / 3) + i % 3] = spots.pixels[i];
  write_image(folder_ / "spots.png", opaque, {});
  const Outcome outcome = train({"--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(read_image(folder_ / "out/t/spots/small/seed1.png").image.channels, 4);
}

TEST_F(TrainCommand, ATrainingAnewLeavesNoSamplesOfTheOneBefore) {
  write_config();
  ASSERT_EQ(train({"--quiet"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/t/models/spots_small_000060.png"));
  write_text(folder_ / "out/t/models/spots_small_notes.png", "the user's");
  ASSERT_EQ(train({"--quiet", "--set", "model.small.steps=[10]"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/t/models/spots_small_000020.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out/t/models/spots_small_000060.png"));
  EXPECT_EQ(file("out/t/models/spots_small_notes.png"), "the user's");
}

TEST_F(TrainCommand, WhatCannotBeTrainedIsSaidBefore) {
  write_config();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"steps=[40, 0]", "steps = 0 of the finest level"},
      {"crop=[16]", ""},
      {"adversary_layers=[8]", ""},  // one level less
      {"patch_size=[9, 9, 11]", "crop = 16 of level 1 is too small"}};
  for (const auto& [set, why] : cases) {
    const Outcome outcome =
        run({"check", "t.toml", "--set", "model.small." + set, "--set",
             why.starts_with("crop") ? "model.small.crop=[16]" : "model.small.seed=1"});
    EXPECT_THAT(outcome.output, HasSubstr(why.empty() ? "spots_small" : why)) << set;
  }
}

TEST_F(TrainCommand, ABlendIsEachOfItsMaterials) {
  write_config("blend = true\n", "[[exemplar]]\nname = 'rings'\nimage = 'rings.png'\n");
  const Outcome outcome = train({"--quiet", "--set", "model.small.steps=[160, 100]"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto image = [&](const char* file) { return read_image(folder_ / file).image; };
  const auto mean = [](const Image& picture, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < picture.pixels.size(); i += 3) sum += picture.pixels[i];
    return sum / (static_cast<double>(picture.pixels.size()) / 3);
  };
  // Each is nearer to its own mean colours than to the other's.
  const Image spots = image("spots.png"), rings = image("rings.png");
  for (const bool first : {true, false}) {
    const Image made = image(first ? "out/t/spots/small/seed1.png" : "out/t/rings/small/seed1.png");
    double own = 0, other = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      own += std::abs(mean(made, c) - mean(first ? spots : rings, c));
      other += std::abs(mean(made, c) - mean(first ? rings : spots, c));
    }
    EXPECT_LT(own, other);
  }
}

TEST_F(TrainCommand, OneThatFailsDoesNotStopTheOthers) {
  write_config("", "[[exemplar]]\nname = 'tiny'\nimage = 'tiny.png'\n");
  write_image(folder_ / "tiny.png", Image(5, 5, 3, 0.5f), {});
  const Outcome outcome = train({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("tiny_small: failed: the exemplar is too small"));
  EXPECT_TRUE(fs::exists(folder_ / "out/t/spots/small/seed1.png"));
}

TEST_F(TrainCommand, APartOfIt) {
  write_config("[[method]]\nname = 'big'\nkind = 'phase'\n",
               "[[exemplar]]\nname = 'rings'\nimage = 'rings.png'\n");
  const Outcome checked = run({"check", "t.toml", "--only", "rings/*"});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors;
  EXPECT_THAT(checked.output, HasSubstr("rings_small"));
  EXPECT_THAT(checked.output, Not(HasSubstr("spots_small")));
  const Outcome model = run({"check", "t.toml", "--only", "rings/small"});
  EXPECT_EQ(model.exit_code, 0) << model.errors;
  EXPECT_THAT(model.output, HasSubstr("rings_small"));
  EXPECT_EQ(run({"check", "t.toml", "--only", "moss"}).exit_code, 2);
  const Outcome outcome = train({"--quiet", "--only", "rings/small"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder_ / "out/t/models/rings_small.safetensors"));
  EXPECT_TRUE(fs::exists(folder_ / "out/t/rings/small/seed1.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out/t/rings/big/seed1.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out/t/models/spots_small.safetensors"));
}

TEST_F(TrainCommand, LearnsMapsWithThePicture) {
  write_config("[[method]]\nname = 'big'\nkind = 'phase'\n", "maps = { mask = 'm.png' }\n");
  Image map(64, 64, 4, 0.5f);
  for (std::size_t i = 0; i < map.pixels.size(); i += 4) map.pixels[i] = i % 64 < 32 ? 0.2f : 0.8f;
  write_image(folder_ / "m.png", map, {});
  const Outcome outcome = train({"--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Image made = read_image(folder_ / "out/t/spots/small/seed1_mask.png").image;
  EXPECT_EQ(made.channels, 4);  // with its alpha
  EXPECT_EQ(made.size(), (Size{64, 64}));
  const Outcome alone = run({"generate", "out/t/models/spots_small.safetensors", "--size", "64",
                             "--tile", "both", "--output", "g.png", "--pixel-type", "uint8"});
  ASSERT_EQ(alone.exit_code, 0) << alone.errors;
  EXPECT_EQ(read_image(folder_ / "g_mask.png").image, made);
}

TEST_F(TrainCommand, ModelsOfOneNameAreRefused) {
  write_config(
      "blend = true\nexemplars = ['spots', 'rings']\n"
      "[[model]]\nname = 'b'\nkind = 'generator'\nexemplars = ['spots']\n",
      "[[exemplar]]\nname = 'rings'\nimage = 'rings.png'\n");
  const Outcome outcome = train({"--set", "model.small.name='spots_b'"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("two models would be called 'spots_b'"));
}

TEST_F(TrainCommand, WhatNoPreviewCanUseIsSaidBeforeTheWork) {
  write_config();
  write_text(folder_ / "none.png", "no picture");
  const Outcome outcome = train({"--set", "preview.second=none.png"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("preview: "));
  EXPECT_THAT(outcome.errors, HasSubstr("none.png"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(TrainCommand, SaysWhatIsWrongInOneLine) {
  const auto expect = [&](std::vector<std::string> words, const std::string& why) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << why;
    EXPECT_THAT(outcome.errors, HasSubstr(why));
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  };
  write_config("", "");
  const Outcome checked = run({"check", "t.toml"});
  EXPECT_EQ(checked.exit_code, 0);
  EXPECT_THAT(checked.output, HasSubstr("spots_small"));
  expect({"run", "t.toml"}, "a [[model]] is for 'gramloom train'");
  expect({"train", "t.toml", "--set", "model.small.patch_size=[4]"}, "t.toml:");
  expect({"train", "e.toml"}, "e.toml");
  expect({"train", "t.toml", "--set", "model.small.noise=[5]"},
         "noise = 5: allowed are multiples of 4");
  expect({"train", "t.toml", "--set", "model.small.exemplars=['moss']"},
         "no exemplar is called 'moss'");
  expect({"train", "t.toml", "--set", "model.small.blend=true"}, "is of 2 to 8 exemplars");
  expect({"train", "t.toml", "--set", "model.small.kind='gan'"}, "kind");
  expect({"train", "t.toml", "--only", "moss/*"},
         "--only moss/*: no model of t.toml matches (there are spots/small)");
  expect({"generate", "t.toml", "--size", "8", "--output", "g.png"}, "t.toml");
  expect({"generate", "moss", "--size", "8", "--output", "g.png"}, "unknown model 'moss'");
  expect({"generate", "pebbles", "--size", "8x", "--output", "g.png"},
         "needed is SIDE|WIDTHxHEIGHT");
  expect({"generate", "pebbles", "--size", "8", "--output", "g.png", "--weights", "1,2"},
         "2 numbers are given, the model has 1 materials");
  fs::create_directories(folder_ / "foreign/models");
  write_text(folder_ / "foreign/models/spots_small.csv", "mine\n1\n");
  expect({"train", "t.toml", "--output", "foreign"}, "which no training of gramloom made");
  fs::remove(folder_ / "foreign/models/spots_small.csv");
  write_text(folder_ / "foreign/models/spots_small.safetensors", "mine");
  expect({"train", "t.toml", "--output", "foreign"}, "which no training of gramloom made");
}

}  // namespace
}  // namespace gramloom
