// `gramloom maps`: maps of height maps, of normal maps and of photographs.
#include <algorithm>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class MapsOfPictures : public Workspace {
 protected:
  MapsOfPictures() {
    Image height({32, 32}, 1);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) *height.at(x, y) = static_cast<float>(x) / 64;
    write_image(folder_ / "ramp_height.png", height, {PixelType::uint16, "", {}});
    write_image(folder_ / "ramp_height.exr", height, {PixelType::half, "", {}});
  }

  Image picture(const std::string& name) const { return read_image(folder_ / name).image; }
  // The one line of a refusal.
  std::string refusal(const std::vector<std::string>& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    return outcome.errors;
  }
};

TEST_F(MapsOfPictures, ARampGivesItsExactNormalIn16BitsAndHalf) {
  for (const std::string end : {"png", "exr"}) {
    const Outcome outcome = run({"maps", "ramp_height." + end, "--normal", "--occlusion",
                                 "--curvature", "--strength", "64", "--output", end});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, end + "/ramp_normal." + end + "\n" + end + "/ramp_occlusion." + end +
                                  "\n" + end + "/ramp_curvature." + end + "\n");
    const ImageFile normals = read_image(folder_ / end / ("ramp_normal." + end));
    EXPECT_EQ(normals.encoding.pixel_type, end == "png" ? PixelType::uint16 : PixelType::half);
    const double s = std::sqrt(0.5);  // a slope of one
    EXPECT_NEAR(normals.image.at(7, 9)[0], (1 - s) / 2, 5e-4);
    EXPECT_NEAR(normals.image.at(7, 9)[1], 0.5, 5e-4);
    EXPECT_NEAR(normals.image.at(7, 9)[2], (1 + s) / 2, 5e-4);
    EXPECT_NEAR(*picture(end + "/ramp_occlusion." + end).at(16, 16), 1, 2e-3);
    EXPECT_NEAR(*picture(end + "/ramp_curvature." + end).at(16, 16), 0.5, 2e-3);
  }
}

TEST_F(MapsOfPictures, GreenAndTypesAreByName) {
  Image height({8, 8}, 1);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) *height.at(x, y) = static_cast<float>(y) / 8;
  write_image(folder_ / "h.png", height, {});
  ASSERT_EQ(run({"maps", "h.png", "--normal", "--output", "up"}).exit_code, 0);
  ASSERT_EQ(run({"maps", "h.png", "--normal", "--green", "down", "--format", "exr", "--pixel-type",
                 "float", "--output", "down"})
                .exit_code,
            0);
  EXPECT_GT(picture("up/h_normal.png").at(4, 4)[1], 0.8f) << "the ground faces up the picture";
  EXPECT_LT(picture("down/h_normal.exr").at(4, 4)[1], 0.2f);
  EXPECT_EQ(read_image(folder_ / "down/h_normal.exr").encoding.pixel_type, PixelType::float32);
}

TEST_F(MapsOfPictures, AHeightComesBackFromItsNormals) {
  ASSERT_EQ(run({"maps", "ramp_height.png", "--normal", "--strength", "16"}).exit_code, 0);
  const Outcome outcome =
      run({"maps", "ramp_normal.png", "--height", "--strength", "16", "--output", "back"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("note: ramp_height.png: 1 stands for 7.7"), std::string::npos)
      << outcome.errors;
  const Image height = picture("back/ramp_height.png");
  for (int x = 0; x < 32; ++x) EXPECT_NEAR(*height.at(x, 9), x / 31.0, 0.01);
}

TEST_F(MapsOfPictures, APhotographBecomesAnExemplarWithItsMaps) {
  const Outcome outcome =
      run({"maps", "e.png", "--from-photo", "--green", "down", "--output", "photo"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("e_height.png: guessed"), std::string::npos) << outcome.errors;
  const std::string config = outcome.output.substr(outcome.output.find("[[exemplar]]"));
  EXPECT_EQ(
      config,
      "[[exemplar]]\nname  = \"e\"\nimage = \"photo/e_colour.png\"\nmaps  = { height = "
      "\"photo/e_height.png\", roughness = \"photo/e_roughness.png\", normal = { image = "
      "\"photo/e_normal.png\", green = \"down\" }, occlusion = \"photo/e_occlusion.png\" }\n");
  EXPECT_EQ(picture("photo/e_colour.png").size(), picture("e.png").size());
  EXPECT_EQ(read_image(folder_ / "photo/e_height.png").encoding.pixel_type, PixelType::uint16);
}

TEST_F(MapsOfPictures, NothingIsWrittenOverThatIsReadOrNotOurs) {
  EXPECT_EQ(refusal({"maps", "e.png", "--normal"}),
            "e.png: a height map has 3 channels that differ, allowed is 1\n");
  ASSERT_EQ(run({"maps", "ramp_height.png", "--normal"}).exit_code, 0);
  ASSERT_EQ(run({"maps", "ramp_height.png", "--normal"}).exit_code, 0) << "its own, again";
  EXPECT_EQ(refusal({"maps", "ramp_normal.png", "--height", "--normal"}),
            "maps ramp_normal.png: would replace ramp_height.png, which this command did not "
            "make\n");
  fs::create_directory(folder_ / "o");
  fs::create_symlink(folder_ / "ramp_height.png", folder_ / "o/ramp_normal.png");
  EXPECT_EQ(refusal({"maps", "ramp_height.png", "--normal", "--output", "o"}),
            "maps ramp_height.png: would write over o/ramp_normal.png, the same file as "
            "ramp_height.png, which the maps are made of\n");
  EXPECT_EQ(refusal({"maps", "ramp_height.png"}),
            "maps ramp_height.png: no map is asked for; there are --normal, --occlusion and "
            "--curvature of a height map, --height of a normal map, and --from-photo\n");
  EXPECT_EQ(refusal({"maps", "ramp_height.png", "--normal", "--strength", "-1"}),
            "--strength: -1 is not a number, 0.001 to 100000 (see --help)\n");
  EXPECT_EQ(refusal({"maps", "e.png", "--from-photo", "--corners", "1,2,3"}),
            "e.png: corners has 3 numbers, allowed are 8: x and y of four corners\n");
  EXPECT_EQ(refusal({"maps", "ramp_height.png", "--height", "--output", "h"}),
            "ramp_height.png: a normal map has 1 channels, allowed are 3 or more\n");
  EXPECT_EQ(refusal({"maps", "ramp_height.png", "--normal", "--format", "jpg", "--output", "j",
                     "--cast", "grey"}),
            "--cast requires --from-photo (see --help)\n");
}

}  // namespace
}  // namespace gramloom
