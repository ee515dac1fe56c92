// From file to file: maps and pictures keep their values, or the job's record says why not.
#include <gmock/gmock.h>

#include <set>

#include "jobs/exemplar.h"
#include "jobs/results.h"
#include "jobs/run_folder.h"

namespace gramloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string with_height =
    "size = [40, 24]\nscores = false\n"
    "[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { h = 'h.tif' }\n"
    "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n";

class Values : public Runner {
 protected:
  // Whole numbers from -4280 to 5040 as floats: what a map of 16 signed bits is read as.
  void write_heights() const {
    Image height(32, 32, 1);
    Random random(5);
    for (float& value : height.pixels) value = static_cast<float>(random.below(9321)) - 4280;
    height.pixels.front() = -4280;
    height.pixels.back() = 5040;
    write_image(folder_ / "h.tif", height, {PixelType::float32, "", {}});
  }
  std::set<float> values_of(const std::filesystem::path& file) const {
    const Image image = read_image(file).image;
    return {image.pixels.begin(), image.pixels.end()};
  }
};

TEST_F(Values, HeightsThatAreCopiedComeOutAsTheNumbersTheyWere) {
  write_heights();
  EXPECT_EQ(run_text(with_height).done, 1);
  const std::set<float> before = values_of(folder_ / "h.tif");
  for (const float value : values_of(out("e/b/seed1_h.exr"))) EXPECT_TRUE(before.contains(value));
  EXPECT_THAT(record("e/b/seed1").notes, IsEmpty());
}

TEST_F(Values, HeightsInAnIntegerFileAreScaledAndTheRecordSaysSo) {
  write_heights();
  EXPECT_EQ(run_text(with_height, {}, {"pixel_type=uint16"}).done, 1);
  EXPECT_THAT(record("e/b/seed1").notes,
              ElementsAre("seed1_h.png: 0 stands for -4280 and 1 for 12104"));
  const std::set<float> before = values_of(folder_ / "h.tif");
  for (const float value : values_of(out("e/b/seed1_h.png"))) {
    const float height = -4280 + value * 16384;
    const auto above = before.lower_bound(height - 0.2f);
    EXPECT_TRUE(above != before.end() && *above < height + 0.2f) << height;
  }
}

TEST_F(Values, WhatReadingAndWritingChangeIsInTheRecord) {
  Image hdr(32, 32, 3);
  for (std::size_t i = 0; i < hdr.pixels.size(); ++i)
    hdr.pixels[i] = 1e5f + static_cast<float>(i % 7);
  write_image(folder_ / "hdr.exr", hdr, {PixelType::float32, "", {}});
  const std::string text =
      "size = 24\nscores = false\npixel_type = 'half'\n"
      "[[exemplar]]\nname = 'e'\nimage = 'hdr.exr'\n"
      "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n";
  EXPECT_EQ(run_text(text).done, 1);
  EXPECT_THAT(record("e/b/seed1").notes,
              ElementsAre(HasSubstr("seed1.exr: 100 % of the values, which reach from ")));
  EXPECT_EQ(values_of(out("e/b/seed1.exr")), (std::set<float>{65504}));
  EXPECT_EQ(run_text(text, {}, {"format=jpg"}).done, 1);
  EXPECT_THAT(record("e/b/seed1").notes,
              ElementsAre("seed1.jpg: half became uint8, the best that a jpeg file has",
                          HasSubstr("seed1.jpg: 100 % of the values, which reach from ")));
}

TEST_F(Values, MissingDataIsRefusedOrNamed) {
  Image height(32, 32, 1, 0.25f);
  height.pixels[7] = -3.4e38f;
  write_image(folder_ / "h.tif", height, {PixelType::float32, "", {}});
  EXPECT_EQ(run_text(with_height).failed, 1);
  EXPECT_THAT(record("e/b/seed1").error,
              HasSubstr("h.tif: the value at x 7, y 0, channel 0 is -3.4e+38, a mark for missing"));
  height.pixels[7] = -9999;
  write_image(folder_ / "h.tif", height, {PixelType::float32, "", {}});
  EXPECT_EQ(run_text(with_height).done, 1);
  EXPECT_THAT(record("e/b/seed1").notes, ElementsAre(HasSubstr("of the values are -9999")));
}

TEST_F(Values, AFlatMapComesBack) {
  for (const float value : {-7.0f, 1e9f, 1.5f}) {
    write_image(folder_ / "h.tif", Image(32, 32, 1, value), {PixelType::float32, "", {}});
    EXPECT_EQ(run_text(with_height).done, 1);
    EXPECT_EQ(values_of(out("e/b/seed1_h.exr")), (std::set<float>{value}));
  }
}

TEST_F(Values, ADeepOrBrokenRecordIsNoRecord) {
  run_text(two_textures);
  EXPECT_EQ(resume(two_textures).skipped, 2);
  write_text(out("e/b/seed1.json"), std::string(200'000, '[') + std::string(200'000, ']'));
  EXPECT_EQ(resume(two_textures).done, 1);
  // What is no run.json of ours may be somebody's own.
  write_text(out("run.json"), std::string(200'000, '[') + std::string(200'000, ']'));
  EXPECT_THROW(resume(two_textures), ConfigError);
}

}  // namespace
}  // namespace gramloom
