// `gramloom fill`, `gramloom arrange` and configs with [fill] from the command line.
#include <gmock/gmock.h>

#include <cmath>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FillCommand : public Workspace {
 protected:
  FillCommand() {
    Image mask(32, 32, 1);
    for (int y = 10; y < 16; ++y)
      for (int x = 12; x < 20; ++x) *mask.at(x, y) = 1;
    write_image(folder_ / "hole.png", mask, {});
    write_text(folder_ / "f.toml",
               "coordinates = true\n[fill]\nimage = 'e.png'\nmask = 'hole.png'\nblend = 0\n"
               "[[method]]\nname = 'patchmatch'\nkind = 'patchmatch'\n");
  }
};

TEST_F(FillCommand, MakesWhatItsPrintedConfigMakes) {
  const Outcome outcome =
      run({"fill", "e.png", "--mask", "hole.png", "--output", "whole.png", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "whole.png\n");
  const Outcome config = run({"fill", "e.png", "--mask", "hole.png", "--print-config"});
  ASSERT_EQ(config.exit_code, 0) << config.errors;
  write_text(folder_ / "p.toml", config.output);
  const Outcome made = run({"run", "p.toml", "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  const Image whole = read_image(folder_ / "whole.png").image;
  EXPECT_EQ(read_image(folder_ / "out/p/e/patchmatch/seed1.png").image, whole);
  const Image before = read_image(folder_ / "e.png").image;
  const Image mask = read_image(folder_ / "hole.png").image;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    if (mask.pixels[i / 3] == 0) {
      ASSERT_EQ(whole.pixels[i], before.pixels[i]);
    }
}

TEST_F(FillCommand, KeepsBitsProfileAndMetadata) {
  ImageFile picture = read_image(folder_ / "e.png");
  picture.encoding.pixel_type = PixelType::uint16;
  picture.encoding.icc_profile = "not a profile that anybody reads, but bytes that must stay";
  for (float& value : picture.image.pixels) value *= 0.9f;
  write_image(folder_ / "deep.tif", picture.image, picture.encoding, {{"Copyright", "somebody"}});
  const Outcome outcome = run({"fill", "deep.tif", "--mask", "hole.png", "--output", "whole.tif"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const ImageFile before = read_image(folder_ / "deep.tif");
  const ImageFile after = read_image(folder_ / "whole.tif");
  EXPECT_EQ(after.encoding, before.encoding);
  EXPECT_EQ(after.metadata.at("Copyright"), "somebody");
  EXPECT_EQ(after.image.pixels.front(), before.image.pixels.front());
}

TEST_F(FillCommand, KeepsTheResolution) {
  const Image picture = read_image(folder_ / "e.png").image;
  write_image(folder_ / "print.png", picture, {},
              {{"XResolution", "150"}, {"YResolution", "75"}, {"ResolutionUnit", "in"}});
  const Outcome outcome =
      run({"fill", "print.png", "--mask", "hole.png", "--output", "whole.png", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string bytes = file("whole.png");
  const std::size_t at = bytes.find("pHYs");  // pixels a metre, two numbers of 32 bits
  ASSERT_NE(at, std::string::npos);
  const auto number = [&](std::size_t first) {
    int value = 0;
    for (std::size_t i = first; i < first + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes.at(i));
    return value;
  };
  EXPECT_NEAR(number(at + 4), 150 / 0.0254, 1);
  EXPECT_NEAR(number(at + 8), 75 / 0.0254, 1);
}

TEST_F(FillCommand, CoordinatesArrangeTheSamePictureAgain) {
  ASSERT_EQ(run({"run", "f.toml", "--quiet"}).exit_code, 0);
  const std::string coordinates = "out/f/e/patchmatch/seed1_coordinates.tif";
  const Outcome outcome = run({"arrange", coordinates, "e.png", "--output", "again.png"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(read_image(folder_ / "again.png").image,
            read_image(folder_ / "out/f/e/patchmatch/seed1.png").image);
  EXPECT_EQ(run({"arrange", coordinates, "e.png", "e.png", "--output", "a.png"}).exit_code, 2);
  EXPECT_EQ(run({"arrange", coordinates, "e.png", "--output", "a.jpg"}).exit_code, 2);
  EXPECT_EQ(run({"arrange", "e.png", "e.png", "--output", "a.png"}).exit_code, 2);
  EXPECT_EQ(run({"arrange", coordinates, "e.png", "--output", "e.png"}).exit_code, 2);
  EXPECT_EQ(run({"arrange", coordinates, "e.png", "--output", "none/a.png"}).exit_code, 2);
}

TEST_F(FillCommand, ARunResumesAndKeepsWhatItWasAsked) {
  ASSERT_EQ(run({"run", "f.toml", "--quiet"}).exit_code, 0);
  for (const char* name : {"exemplar.png", "exemplar_usable.png", "target_mask.png"})
    EXPECT_TRUE(fs::exists(folder_ / "out/f/e" / name)) << name;
  EXPECT_THAT(file("out/f/index.html"), HasSubstr("what is made anew"));
  EXPECT_EQ(run({"run", "f.toml", "--baseline", "out/f", "--output", "now", "--quiet"}).exit_code,
            0);
  const auto before = record("e/patchmatch/seed1", "out/f");
  ASSERT_TRUE(before);
  EXPECT_TRUE(before->metrics.contains("join"));
  const Outcome again = run({"run", "f.toml", "--resume"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("finished before"));
  Image other = read_image(folder_ / "hole.png").image;
  *other.at(0, 0) = 1;
  write_image(folder_ / "hole.png", other, {});
  const Outcome changed = run({"run", "f.toml", "--resume"});
  EXPECT_EQ(changed.exit_code, 0);
  EXPECT_THAT(changed.errors, testing::Not(HasSubstr("finished before")));
}

TEST_F(FillCommand, AFileOfTheUserIsNotTakenForAnOldGuide) {
  ASSERT_EQ(run({"run", "f.toml", "--quiet"}).exit_code, 0);
  ASSERT_EQ(run({"run", "f.toml", "--quiet"}).exit_code, 0);  // its own are replaced
  write_image(folder_ / "out/f/e/target_guide.png", Image(8, 8, 1, 0.5f), {});
  const std::string before = file("out/f/e/target_guide.png");
  const Outcome outcome = run({"run", "f.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("target_guide.png, which no run of gramloom made"));
  EXPECT_EQ(file("out/f/e/target_guide.png"), before);
}

TEST_F(FillCommand, AWiderPixelTypeKeepsValues) {
  const Image picture = read_image(folder_ / "e.png").image;
  write_image(folder_ / "e16.png", picture, {PixelType::uint16, "", {}});
  const Outcome outcome = run({"fill", "e16.png", "--mask", "hole.png", "--output", "a.exr"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Image before = read_image(folder_ / "e16.png").image;
  const Image after = read_image(folder_ / "a.exr").image;
  const Image hole = read_image(folder_ / "hole.png").image;
  for (int y = 0; y < before.height; ++y)
    for (int x = 0; x < before.width; ++x) {
      if (*hole.at(x, y) > 0.5f) continue;
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(std::lround(after.at(x, y)[c] * 65535), std::lround(before.at(x, y)[c] * 65535));
    }
}

TEST_F(FillCommand, MistakesAreOneLineAndExitCode2) {
  write_image(folder_ / "e16.png", read_image(folder_ / "e.png").image,
              {PixelType::uint16, "", {}});
  write_image(folder_ / "grey.png", Image(64, 64, 1, 0.5f), {});
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"e.png", "--output", "a.png"}, "needs 'mask', 'seamless' or 'extend'"},
      {{"e.png", "--mask", "hole.png"}, "--output or --print-config"},
      {{"e.png", "--mask", "hole.png", "--output", "e.png"}, "would write over e.png"},
      {{"e.png", "--mask", "hole.png", "--output", "a.xyz"}, "extension '.xyz'"},
      {{"e.png", "--mask", "hole.png", "--method", "phase", "--output", "a.png"},
       "methods that can"},
      {{"e.png", "--mask", "hole.png", "--method", "pixle", "--output", "a.png"}, "pixel"},
      {{"e.png", "--mask", "hole.png", "--output", "a.jpg"}, "would not keep"},
      {{"e16.png", "--mask", "hole.png", "--output", "a.bmp"}, "cannot hold the pixel type uint16"},
      {{"e.png", "--mask", "hole.png", "--method", "procedural", "--output", "a.png"},
       "methods that can"},
      {{"e.png", "--mask", "hole.png", "--from", "grey.png", "--output", "a.png"},
       "grey.png has 1 channels, and of"},
      {{"e16.png", "--mask", "hole.png", "--output", "a.hdr"}, "would not keep"},
      {{"e.png", "--mask", "hole.png", "--output", "none/a.png"}, "there is no folder"},
      {{"e.png", "--mask", "nothing.png", "--output", "a.png"}, "nothing.png"},
  };
  for (const auto& [arguments, message] : cases) expect_refused("fill", arguments, message);
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

}  // namespace
}  // namespace gramloom
