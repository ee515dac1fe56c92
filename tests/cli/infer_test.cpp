// Inferred textures from the command line: trained on a table of pairs, used for poses.
#include <gmock/gmock.h>

#include <cmath>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InferCommand : public Workspace {
 protected:
  InferCommand() {
    std::string table = "picture,bend,twist\n";
    for (int i = 0; i < 12; ++i) {
      const double bend = 10 * (i % 4), twist = i / 4 - 1;
      Image picture(8, 8, 1);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
          picture.at(x, y)[0] =
              static_cast<float>(-1 + 0.05 * bend * std::sin(0.8 * x + twist) + y);
      write_image(folder_ / fmt::format("p{}.exr", i), picture, {PixelType::float32, "", {}});
      table += fmt::format("p{}.exr,{},{}\n", i, bend, twist);
    }
    write_text(folder_ / "pairs.csv", table);
    config("pairs = 'pairs.csv'\n");
  }

  void config(const std::string& keys) const {
    write_text(folder_ / "i.toml",
               "[[model]]\nname = 'folds'\nkind = 'inference'\nhidden = [8, 4]\npose_hidden = 8\n"
               "steps = 30\nbatch = 4\nsample_every = 15\n" +
                   keys);
  }
  Outcome train(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"train", "i.toml", "--output", "o"});
    return run(more);
  }
  void expect_refused(std::vector<std::string> words, const std::string& says) const {
    words.insert(words.begin(), {"infer", model_});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(says));
  }

  const std::string model_ = "o/models/folds.safetensors";
};

TEST_F(InferCommand, LearnsPairsAndInfersPictures) {
  const Outcome trained = train();
  ASSERT_EQ(trained.exit_code, 0) << trained.errors;
  EXPECT_THAT(trained.errors, HasSubstr("relative error on 1 held-out pairs: "));
  for (const char* name :
       {"folds.csv", "folds_000015.png", "folds_000030.png", "folds_held_out.png"})
    EXPECT_TRUE(fs::exists(folder_ / "o/models" / name)) << name;
  EXPECT_FALSE(fs::exists(folder_ / "o/models/folds.checkpoint"));
  const std::string bytes = file(model_);
  EXPECT_EQ(bytes.find(folder_.string()), std::string::npos) << "it tells where it was made";

  const Outcome one = run({"infer", model_, "--pose", "30,-0.5", "--output", "x.exr"});
  EXPECT_EQ(one.exit_code, 0) << one.errors;
  EXPECT_EQ(one.output, "x.exr\n");
  const ImageFile picture = read_image(folder_ / "x.exr");
  EXPECT_EQ(picture.image.size(), (Size{8, 8}));
  EXPECT_EQ(picture.encoding.pixel_type, PixelType::float32);

  const Outcome png = run({"infer", model_, "--pose", "30,-0.5", "--output", "x.png"});
  EXPECT_EQ(png.exit_code, 0) << png.errors;
  EXPECT_THAT(png.errors, HasSubstr("x.png: 0 stands for -"));

  // A sequence, and a table in another order: the same pictures where poses are the same.
  ASSERT_EQ(run({"infer", model_, "--pose", "0,1", "--to", "30,-0.5", "--frames", "3", "--output",
                 "s", "--quiet"})
                .output,
            "s/frame_0001.exr\ns/frame_0002.exr\ns/frame_0003.exr\n");
  EXPECT_EQ(read_image(folder_ / "s/frame_0003.exr").image, picture.image);
  write_text(folder_ / "poses.csv", "twist,frame,bend\n-0.5,1,30\n0,2,15\n");
  EXPECT_EQ(run({"infer", model_, "--poses", "poses.csv", "--output", "t", "--quiet"}).exit_code,
            0);
  EXPECT_EQ(read_image(folder_ / "t/frame_0001.exr").image, picture.image);

  // Finished models are kept.
  const Outcome again = train({"--resume"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("folds: trained before"));
  EXPECT_EQ(file(model_), bytes);
}

TEST_F(InferCommand, MistakesAreOneLineAndExitCode2) {
  ASSERT_EQ(train({"--quiet"}).exit_code, 0);
  expect_refused({"--pose", "31,0", "--output", "x.exr"},
                 "--pose 31,0: bend = 31: the model has learnt 0 to 30");
  EXPECT_EQ(
      run({"infer", model_, "--pose", "31,0", "--output", "x.exr", "--extrapolate"}).exit_code, 0);
  expect_refused({"--pose", "-5,0", "--output", "y.exr"}, "bend = -5");
  expect_refused({"--pose", "3", "--output", "y.exr"},
                 "a pose of 1 numbers, the model's has 2: bend, twist");
  expect_refused({"--pose", "3,x", "--output", "y.exr"}, "--pose 3,x: 'x' is not a number");
  expect_refused({"--output", "y.exr"}, "needed is --pose or --poses");
  expect_refused({"--pose", "3,0", "--output", "e.png"}, "would replace e.png");
  expect_refused({"--pose", "3,0", "--output", "y.xyz"}, "xyz");
  write_text(folder_ / "q.csv", "bend\n3\n");
  expect_refused({"--poses", "q.csv", "--output", "t"}, "q.csv:1: has no column 'twist'");
  write_text(folder_ / "q.csv", "bend,twist\n3,0\n3,9\n");
  expect_refused({"--poses", "q.csv", "--output", "t"},
                 "q.csv:3: twist = 9: the model has learnt -1 to 1");
  EXPECT_FALSE(fs::exists(folder_ / "y.exr"));
  write_text(folder_ / model_, "no model");
  expect_refused({"--pose", "3,0", "--output", "y.exr"}, "folds.safetensors");
}

TEST_F(InferCommand, PairsThatDoNotMatchFailInOneLine) {
  write_text(folder_ / "pairs.csv", file("pairs.csv") + "q.exr,3,0\n");
  const Outcome outcome = train({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("folds: failed: "));
  EXPECT_THAT(outcome.errors, HasSubstr("pairs.csv:14: "));
  config("");
  const Outcome neither = train();
  EXPECT_EQ(neither.exit_code, 2);
  EXPECT_THAT(neither.errors, HasSubstr("i.toml:3:"));
}

TEST_F(InferCommand, ASimulationIsMadeOnce) {
  write_text(folder_ / "s.toml",
             "poses = 8\n[sleeve]\nsize = [16, 24]\nsteps = 4\niterations = 2\n");
  config("simulation = 's.toml'\n");
  const Outcome outcome = train({"--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const fs::path table = folder_ / "o/data/folds/poses.csv";
  const auto made = fs::last_write_time(table);
  fs::remove(folder_ / model_);
  ASSERT_EQ(train({"--quiet", "--resume"}).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(table), made);
}

}  // namespace
}  // namespace gramloom
