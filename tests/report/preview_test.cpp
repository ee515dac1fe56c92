#include "report/preview.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/error.h"
#include "io/temp_folder.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

ImageFile file_of(Image image, const std::string& colour_space = "",
                  PixelType type = PixelType::float32) {
  return {std::move(image), {type, colour_space, {}}, {}, {}};
}

TEST(Preview, LinearValuesGetTheCurveAndOthersStay) {
  const Image half(1, 1, 3, 0.5f);
  for (const std::string linear : {"Linear", "lin_srgb", "scene_linear"})
    EXPECT_NEAR(preview(file_of(half, linear), 1).pixels[0], 0.735357f, 1e-5f) << linear;
  for (const std::string encoded : {"sRGB", "", "Gamma2.2"})
    EXPECT_EQ(preview(file_of(half, encoded), 1).pixels[0], 0.5f) << encoded;
  EXPECT_NEAR(preview(file_of(Image(1, 1, 1, 0.002f), "Linear"), 1).pixels[0], 0.02584f, 1e-6f);
}

TEST(Preview, ValuesBeyondWhiteAreWhiteAndAlphaIsLeftAlone) {
  Image image(1, 1, 4);
  image.pixels = {-1, 4, 2, 0.25f};
  const Image shown = preview(file_of(image), 4);
  EXPECT_EQ(shown.pixels, (std::vector<float>{0, 1, 0.5f, 0.25f}));
  EXPECT_EQ(preview(file_of(Image(2, 2, 7)), 1).channels, 3);
  EXPECT_EQ(preview(file_of(Image(2, 2, 1)), 1).channels, 1);
}

TEST(Preview, WhiteLeavesOutAFewHighlightsAndIsOneForIntegers) {
  Image image(100, 10, 1, 2.0f);
  image.pixels[3] = 1000;
  EXPECT_EQ(white_of(file_of(image)), 2);
  EXPECT_EQ(white_of(file_of(Image(4, 4, 3, 0.2f))), 1);
  EXPECT_EQ(white_of(file_of(image, "", PixelType::uint16)), 1);
}

class ShownFile : public TempFolder {};

TEST_F(ShownFile, IsTheFileItselfWhereBrowsersShowIt) {
  write_image(path() / "a.png", Image(2, 2, 3), {});
  EXPECT_EQ(shown_file(path(), "a.png", 1), "a.png");
  EXPECT_FALSE(fs::exists(path() / "page"));
}

TEST_F(ShownFile, IsAPreviewThatIsMadeOnceAndAgainForAnotherFile) {
  fs::create_directories(path() / "e/m");
  const auto write = [&](float value) {
    write_image(path() / "e/m/seed1.exr", Image(2, 2, 3, value), {PixelType::half, "sRGB", {}});
  };
  write(1);
  const std::string shown = shown_file(path(), "e/m/seed1.exr", 1);
  EXPECT_EQ(shown, "page/e/m/seed1.exr.png");
  EXPECT_EQ(read_image(path() / shown).image.pixels[0], 1);
  const auto time = fs::last_write_time(path() / "e/m/seed1.exr");
  write_text(path() / shown, "left alone");
  fs::last_write_time(path() / shown, time);
  shown_file(path(), "e/m/seed1.exr", 1);
  EXPECT_EQ(read_text(path() / shown), "left alone");
  float value = 0;
  for (const auto& then : {time + std::chrono::seconds(5), time - std::chrono::hours(24)}) {
    write(value);
    fs::last_write_time(path() / "e/m/seed1.exr", then);
    shown_file(path(), "e/m/seed1.exr", 1);
    EXPECT_EQ(read_image(path() / shown).image.pixels[0], value) << "also where clocks were set";
    value = 1;
  }
}

TEST_F(ShownFile, AFileThatIsMissingOrBrokenIsAnError) {
  EXPECT_THROW(shown_file(path(), "no.png", 1), Error);
  write_text(path() / "broken.tif", "no picture");
  EXPECT_THROW(shown_file(path(), "broken.tif", 1), Error);
}

}  // namespace
}  // namespace gramloom
