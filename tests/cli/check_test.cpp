// What run refuses before a job's work, check says.
#include "cli/workspace.h"
#include "io/safetensors.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Check : public Workspace {
 protected:
  const std::string quilting_ = "[[method]]\nname = 'm'\nkind = 'quilting'\npatch_size = 8\n";
  const std::string neural_ = "[[method]]\nname = 'm'\nkind = 'neural'\npreset = 'fast'\n";

  // Both say this of the only job of "x.toml", and nothing else keeps it from running.
  void expect_both(const std::string& text, const std::string& problem,
                   bool only_begin = false) const {
    write_text(folder_ / "x.toml", text);
    const Outcome check = run({"check", "x.toml"});
    EXPECT_EQ(check.exit_code, 0) << check.errors;
    EXPECT_NE(check.output.find("cannot run: " + problem), std::string::npos) << check.output;
    const Outcome outcome = run({"run", "x.toml", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 1);
    const std::string line = "e/m/seed1: failed: " + problem;
    EXPECT_TRUE(outcome.errors.starts_with(only_begin ? line : line + "\n")) << outcome.errors;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_EQ(record("e/m/seed1", "out/x")->seconds, 0) << "before any work";
    fs::remove_all(folder_ / "out");
  }
  std::string exemplar(const std::string& image) const {
    return "[[exemplar]]\nname = 'e'\nimage = '" + image + "'\n";
  }
};

TEST_F(Check, FormatsThatCannotHoldTheResult) {
  write_image(folder_ / "alpha.png", Image(16, 16, 4, 0.5f), {});
  write_image(folder_ / "many.tif", Image(16, 16, 7, 0.5f), {});
  const std::string choose = ": choose format = \"tif\" or \"exr\"";
  expect_both("size = 24\nformat = 'jpg'\n" + exemplar("alpha.png") + quilting_,
              "a jpg file cannot hold 4 channels" + choose);
  expect_both("size = 24\nformat = 'png'\n" + exemplar("many.tif") + quilting_,
              "a png file cannot hold 7 channels" + choose);
  write_image(folder_ / "map.png", Image(32, 32, 2, 0.5f), {});
  expect_both("size = 24\nformat = 'jpg'\n" + exemplar("e.png") + "maps = { flow = 'map.png' }\n" +
                  quilting_,
              "a jpg file cannot hold 2 channels" + choose);
}

TEST_F(Check, AJpegThatWouldBeTooWide) {
  expect_both("size = [65501, 1]\nformat = 'jpg'\n" + exemplar("e.png") + quilting_,
              "a jpg file cannot hold 65501×1 pixels, a side has at most 65500: choose another "
              "format");
}

TEST_F(Check, ValuesThatNoMethodTakes) {
  Image huge(16, 16, 1, 0.5f);
  huge.pixels[7] = 2e15f;
  write_image(folder_ / "huge.exr", huge, {PixelType::float32, "", {}});
  for (const std::string& method : {quilting_, neural_})
    expect_both("size = 24\n" + exemplar("huge.exr") + method,
                "huge.exr: the exemplar holds values beyond ±1e+15");
}

TEST_F(Check, ManyLevels) {
  expect_both("size = 32\n" + exemplar("e.png") + neural_ + "levels = 64\n",
              "on the coarsest of 64 levels, the exemplar of 1×1 is too small for patches of 7×7: "
              "make patch_sizes smaller; or take fewer levels");
  expect_both("size = 32\n" + exemplar("e.png") + neural_ + "patch_sizes = [40]\n",
              "the exemplar of 32×32 is too small for patches of 40×40: make patch_sizes smaller");
}

TEST_F(Check, APictureTooSmallForTheNetwork) {
  write_text(folder_ / "deep.toml",
             "name = 'deep'\nmatched = ['p3']\n"
             "[[layer]]\nname = 'c'\ntype = 'convolution'\nchannels = 4\n"
             "[[layer]]\nname = 'p1'\ntype = 'average_pool'\n"
             "[[layer]]\nname = 'p2'\ntype = 'average_pool'\n"
             "[[layer]]\nname = 'p3'\ntype = 'max_pool'\n");
  const std::string gram =
      "[[method]]\nname = 'm'\nkind = 'neural'\npreset = 'gatys'\n"
      "network = 'deep.toml'\n";
  expect_both("size = 7\n" + exemplar("e.png") + gram,
              "layer 'p3' of network 'deep' would be empty: a picture of 7×7 is too small for it");
  expect_both("size = 32\n" + exemplar("e.png") + gram + "levels = 7\nlevel_factor = 0.7\n",
              "on the coarsest of 7 levels, layer 'p3' of network 'deep' would be empty: a picture "
              "of 4×4 is too small for it; or take fewer levels");
}

TEST_F(Check, StartPicturesAndWeightsOfOtherShape) {
  write_image(folder_ / "grey.png", Image(16, 16, 1, 0.5f), {});
  expect_both("size = 32\n" + exemplar("e.png") + neural_ + "start = 'grey.png'\n",
              "grey.png: has 1 channels, the exemplar has 3");
  write_tensors(folder_ / "w.safetensors", {{"features.0.weight", {{1}, {0.5f}}}});
  expect_both("size = 32\n" + exemplar("e.png") +
                  "[[method]]\nname = 'm'\nkind = 'neural'\npreset = 'gatys'\n"
                  "network = 'vgg_small'\nweights = 'w.safetensors'\n",
              "w.safetensors: tensor 'features.0.weight' has shape [1], the network needs", true);
}

TEST_F(Check, PeriodsAndCellsThatLeavePiecesNoChoice) {
  const std::string tiling = "[[method]]\nname = 'm'\nkind = 'tiling'\n";
  expect_both(
      "size = 64\n" + exemplar("e.png") + tiling + "period = [20, 8]\n",
      "period = 20 across: pieces of 17 pixels have only 16 places that way, so no multiple "
      "fits some of them; choose a smaller cell or a period up to 16");
  expect_both("size = 64\n" + exemplar("e.png") + tiling + "cell = 0.5\n",
              "cell = 0.5: pieces of 33×28 pixels have 1×5 places", true);
}

TEST_F(Check, EstimatesWithScoresDiversityAndTheProgramItself) {
  const std::string text = run({"check", "c.toml"}).output;
  EXPECT_NE(text.find("e/q diversity"), std::string::npos) << text;
  EXPECT_EQ(text.find("0.00 GB"), std::string::npos) << text;
  EXPECT_EQ(run({"check", "c.toml", "--set", "scores=false"}).output.find("diversity"),
            std::string::npos);
  EXPECT_EQ(run({"check", "c.toml", "--only", "*/seed1"}).output.find("diversity"),
            std::string::npos);
}

}  // namespace
}  // namespace gramloom
