// A data set of folds from the command line.
#include <gmock/gmock.h>

#include "cli/workspace.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

class SimulateCommand : public Workspace {
 protected:
  SimulateCommand() { config("poses = 3\n"); }

  void config(const std::string& top) const {
    write_text(folder_ / "s.toml", top + "[sleeve]\nsize = [16, 24]\nsteps = 4\niterations = 2\n");
  }
  void expect_refused(const std::string& says) const {
    const Outcome outcome = run({"simulate", "s.toml", "--output", "o", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(says));
  }
};

TEST_F(SimulateCommand, MakesATableAndAPictureOfEachPose) {
  const Outcome outcome = run({"simulate", "s.toml", "--output", "o"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "o/poses.csv\n");
  EXPECT_THAT(file("o/poses.csv"), HasSubstr("picture,bend,twist,swing\npose_0001.exr,"));
  const ImageFile picture = read_image(folder_ / "o/pose_0003.exr");
  EXPECT_EQ(picture.image.size(), (Size{16, 24}));
  EXPECT_EQ(picture.image.channels, 1);
  EXPECT_EQ(picture.encoding.pixel_type, PixelType::float32);
}

TEST_F(SimulateCommand, FoldsAreShownOnABentTube) {
  ASSERT_EQ(run({"simulate", "s.toml", "--output", "o", "--quiet"}).exit_code, 0);
  const std::vector<std::string> shown{"preview",
                                       "--map",
                                       "height=o/pose_0001.exr",
                                       "--shape",
                                       "tube",
                                       "--bend",
                                       "70",
                                       "--displacement",
                                       "0.25",
                                       "--size",
                                       "64",
                                       "--samples",
                                       "1",
                                       "--output",
                                       "x.png",
                                       "--detail",
                                       "4"};
  const Outcome outcome = run(shown);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Outcome ball =
      run({"preview", "--map", "height=o/pose_0001.exr", "--bend", "70", "--output", "x.png"});
  EXPECT_EQ(ball.exit_code, 2);
  EXPECT_THAT(ball.errors, HasSubstr("bend = 70: only the tube bends, not 'sphere'"));
  const Outcome nothing = run({"preview", "--output", "x.png"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("needed is a texture, or a map (--map)"));
}

TEST_F(SimulateCommand, MistakesAreOneLineAndExitCode2) {
  config("bendd = [0, 10]\n");
  expect_refused("s.toml:1:1: unknown key 'bendd' (did you mean 'bend'?)");
  config("bend = [80, 10]\n");
  expect_refused("s.toml:1:1: 'bend' = [80, 10]: the least comes first");
  config("poses = 0\n");
  expect_refused("'poses' = 0: allowed are 1 to 100000");
  config("");
  std::filesystem::create_directory(folder_ / "o");
  write_text(folder_ / "o/poses.csv", "a,b\n1,2\n");
  expect_refused("--output o: would replace o/poses.csv, which this command did not make");
  EXPECT_EQ(file("o/poses.csv"), "a,b\n1,2\n");
  std::filesystem::remove_all(folder_ / "o");
  write_text(folder_ / "o", "a file");
  expect_refused("--output o");
  std::filesystem::remove(folder_ / "s.toml");
  expect_refused("s.toml");
}

}  // namespace
}  // namespace gramloom
