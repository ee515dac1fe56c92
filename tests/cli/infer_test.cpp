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
    // In one thread, which such small networks are trained fastest by (tests/train/one_thread.cpp).
    more.insert(more.begin(), {"train", "i.toml", "--output", "o", "--threads", "1"});
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
  write_text(folder_ / "poses.csv", "twist,frame,bend,picture\n-0.5,first of all,30,\n0,,15,\n");
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
                 "--pose 31,0: bend = 31: learnt are 0 to 30");
  EXPECT_EQ(
      run({"infer", model_, "--pose", "31,0", "--output", "x.exr", "--extrapolate"}).exit_code, 0);
  expect_refused({"--pose", "-5,0", "--output", "y.exr"}, "bend = -5");
  expect_refused({"--pose", "3", "--output", "y.exr"},
                 "a pose of 1 numbers, the model's has 2: bend, twist");
  expect_refused({"--pose", "3,x", "--output", "y.exr"}, "--pose 3,x: 'x' is not a number");
  expect_refused({"--output", "y.exr"}, "needed is --pose or --poses");
  expect_refused({"--pose", "3,0", "--output", "e.png"}, "would replace e.png");
  expect_refused({"--pose", "3,0", "--output", "y.xyz"}, "xyz");
  expect_refused({"--pose", "3,0", "--output", "y.exr", "--format", "png"},
                 "--format is for several pictures");
  write_text(folder_ / "q.csv", "bend\n3\n");
  expect_refused({"--poses", "q.csv", "--output", "t"}, "q.csv:1: has no column 'twist'");
  write_text(folder_ / "q.csv", "bend,twist\n3,0\n3,9\n");
  expect_refused({"--poses", "q.csv", "--output", "t"}, "q.csv:3: twist = 9: learnt are -1 to 1");
  EXPECT_FALSE(fs::exists(folder_ / "y.exr"));
  expect_refused(
      {"--pose", "3,0", "--to", "4,0", "--output", "t", "--format", "png", "--frames", "0"},
      "--frames");
  fs::create_directories(folder_ / "u");
  write_text(folder_ / "u/frame_0001.exr", "mine");
  expect_refused({"--pose", "3,0", "--to", "4,0", "--output", "u"}, "would replace u/frame_0001");
  EXPECT_FALSE(fs::exists(folder_ / "t"));
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

  // Before another one is trained, which may take an hour; that one is trained all the same.
  const std::string good = file("i.toml");
  write_text(folder_ / "i.toml",
             "[[model]]\nname = 'later'\nkind = 'inference'\nsteps = 5\n"
             "batch = 4\npairs = 'good.csv'\n" +
                 good);
  std::string table = file("pairs.csv");
  write_text(folder_ / "good.csv", table.substr(0, table.find("q.exr")));
  const Outcome two = train();
  EXPECT_EQ(two.exit_code, 1);
  EXPECT_LT(two.errors.find("folds: failed: "), two.errors.find("later: trained in "));
  EXPECT_TRUE(fs::exists(folder_ / "o/models/later.safetensors"));
  write_image(folder_ / "q.exr", Image(9, 8, 1), {});
  EXPECT_THAT(train({"--quiet"}).errors, HasSubstr("has sides of 8 and 9, the first picture"));

  config("");
  const Outcome neither = train();
  EXPECT_EQ(neither.exit_code, 2);
  EXPECT_THAT(neither.errors, HasSubstr("i.toml:3:"));
}

TEST_F(InferCommand, ATrainingMakesTheFramesThatInferMakes) {
  config("pairs = 'pairs.csv'\npose = [0, 1]\nto = [30, -0.5]\nframes = 3\n");
  const Outcome trained = train();
  ASSERT_EQ(trained.exit_code, 0) << trained.errors;
  EXPECT_THAT(trained.errors, HasSubstr("folds: 3 frames in o/models/folds_frames"));
  const std::string bytes = file(model_);
  ASSERT_EQ(run({"infer", model_, "--pose", "0,1", "--to", "30,-0.5", "--frames", "3", "--output",
                 "s", "--quiet"})
                .exit_code,
            0);
  const auto expect_frames = [&](int count) {
    for (int i = 1; i <= count; ++i) {
      const std::string frame = fmt::format("frame_{:04}.exr", i);
      EXPECT_EQ(file("o/models/folds_frames/" + frame), file("s/" + frame));
    }
  };
  expect_frames(3);

  // They can be asked for, or be lost, when the model is there: it stays as it is.
  fs::remove_all(folder_ / "o/models/folds_frames");
  config("pairs = 'pairs.csv'\npose = [0, 1]\nto = [30, -0.5]\nframes = 5\n");
  ASSERT_EQ(run({"infer", model_, "--pose", "0,1", "--to", "30,-0.5", "--frames", "5", "--output",
                 "s", "--quiet"})
                .exit_code,
            0);
  const Outcome again = train({"--resume"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_THAT(again.errors, HasSubstr("folds: trained before"));
  EXPECT_EQ(file(model_), bytes);
  expect_frames(5);

  // A shorter one leaves none of the longer; what is not ours stays.
  write_image(folder_ / "s/frame_0009.exr", Image(8, 8, 1), {});
  write_text(folder_ / "s/frame_0008.txt", "mine");
  config("pairs = 'pairs.csv'\npose = [0, 1]\nto = [30, -0.5]\nframes = 2\n");
  ASSERT_EQ(run({"infer", model_, "--pose", "0,1", "--to", "30,-0.5", "--frames", "2", "--output",
                 "s", "--quiet"})
                .exit_code,
            0);
  EXPECT_EQ(train({"--resume", "--quiet"}).exit_code, 0);
  expect_frames(2);
  for (const std::string folder : {"o/models/folds_frames/", "s/"})
    for (const char* frame : {"frame_0003.exr", "frame_0005.exr"})
      EXPECT_FALSE(fs::exists(folder_ / (folder + frame))) << folder << frame;
  EXPECT_TRUE(fs::exists(folder_ / "s/frame_0009.exr"));
  EXPECT_TRUE(fs::exists(folder_ / "s/frame_0008.txt"));
}

TEST_F(InferCommand, ThePageShowsTheSequence) {
  config("pairs = 'pairs.csv'\npose = [0, 1]\nto = [30, -0.5]\nframes = 3\n");
  ASSERT_EQ(train({"--quiet"}).exit_code, 0);
  EXPECT_THAT(file("o/index.html"), HasSubstr("models/folds_frames/frame_0003.exr"));
  const Image last = read_image(folder_ / "o/page/models/folds_frames/frame_0003.exr.png").image;
  const auto [low, high] = std::minmax_element(last.pixels.begin(), last.pixels.end());
  EXPECT_GT(*high - *low, 0.5f) << "from the least to the largest value of all";
  fs::remove(folder_ / "o/index.html");
  EXPECT_EQ(run({"report", "o"}).exit_code, 0);
  EXPECT_THAT(file("o/index.html"), HasSubstr("\"twist\":-0.5"));
}

TEST_F(InferCommand, ASequenceThatCannotBeIsRefusedBeforeTraining) {
  const auto expect_no = [&](const std::string& keys, const std::string& says) {
    config("pairs = 'pairs.csv'\n" + keys);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"check", "i.toml"}, {"train", "i.toml", "--output", "o"}}) {
      const Outcome outcome = run(command);
      EXPECT_EQ(outcome.exit_code, 2) << keys;
      EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
      EXPECT_THAT(outcome.errors, HasSubstr(says));
    }
  };
  expect_no("pose = [0, 0]\nto = [31, 0]\n",
            "i.toml:1:1: 'to' = [31, 0]: bend = 31: learnt are 0 to 30");
  expect_no("pose = [0, -2]\nto = [30, 0]\n",
            "i.toml:1:1: 'pose' = [0, -2]: twist = -2: learnt are -1 to 1");
  expect_no("pose = [0]\nto = [31]\n", "a pose of 1 numbers, the model's has 2: bend, twist");
  expect_no("pose = [0, 0]\n", "'pose' has 2 numbers, 'to' has 0");
  expect_no("frames = 3\n", "'frames' is of a sequence, which needs 'pose' and 'to'");
  expect_no("pose = [0, 0]\nto = [1, 0]\nframes = 0\n", "frames");
  EXPECT_FALSE(fs::exists(folder_ / "o"));
  // A simulation's ranges are known before it is made.
  write_text(folder_ / "s.toml", "poses = 8\nbend = [0, 50]\n");
  config("simulation = 's.toml'\npose = [30, 0, 0]\nto = [60, 0, 0]\n");
  EXPECT_THAT(train().errors, HasSubstr("bend = 60: learnt are "));
  EXPECT_FALSE(fs::exists(folder_ / "o"));

  config("pairs = 'pairs.csv'\npose = [0, 0]\nto = [31, 0]\nframes = 2\nextrapolate = true\n");
  fs::create_directories(folder_ / "o/models/folds_frames");
  write_image(folder_ / "o/models/folds_frames/frame_0002.exr", Image(8, 8, 1), {});
  const Outcome foreign = train();
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_THAT(foreign.errors, HasSubstr("frame_0002.exr, which this command did not make"));
  fs::remove_all(folder_ / "o");
  EXPECT_EQ(train({"--quiet"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "o/models/folds_frames/frame_0002.exr"));
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
