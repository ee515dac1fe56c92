#include "report/surface_view.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/error.h"
#include "io/image_file.h"
#include "io/json_text.h"
#include "io/text_file.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::StartsWith;

class SurfaceViews : public testing::Test {
 protected:
  SurfaceViews() : folder_(fs::temp_directory_path() / fmt::format("gramloom_views_{}", getpid())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~SurfaceViews() override { fs::remove_all(folder_); }

  // What the script hands to the page.
  Json data(const SurfaceView& view) const {
    const std::string file = surface_view_file(folder_, "it's/q/seed1", view);
    EXPECT_EQ(file, "page/it's/q/seed1.view.js");
    const std::string text = read_text(folder_ / file);
    const std::string begin = "surfaceData(\"page/it's/q/seed1.view.js\", ";
    EXPECT_THAT(text, StartsWith(begin));
    return parse_json(text.substr(begin.size(), text.size() - begin.size() - 3));
  }
  // The picture in a data address.
  Image picture(const std::string& url) const {
    const auto comma = url.find(',');
    const std::string extension = url.starts_with("data:image/png;base64") ? ".png" : ".jpg";
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned value = 0;
    int bits = 0;
    for (const char c : url.substr(comma + 1)) {
      if (c == '=') break;
      value = value << 6 | static_cast<unsigned>(letters.find(c));
      bits += 6;
      if (bits < 8) continue;
      bits -= 8;
      bytes += static_cast<char>(value >> bits & 0xff);
    }
    write_text(folder_ / ("decoded" + extension), bytes);
    return read_image(folder_ / ("decoded" + extension)).image;
  }

  const fs::path folder_;
};

TEST_F(SurfaceViews, SmallFilesAreTheSameBytesAndHeightsHave16Bits) {
  Image colour(20, 10, 3), height(20, 10, 1);
  for (std::size_t i = 0; i < colour.pixels.size(); ++i)
    colour.pixels[i] = static_cast<float>(i % 256) / 255;
  for (std::size_t i = 0; i < height.pixels.size(); ++i)
    height.pixels[i] = 3 + static_cast<float>(i) / 50;
  write_image(folder_ / "c.png", colour, {});
  write_image(folder_ / "h.exr", height, {PixelType::float32, "", {}});
  const Json found =
      data({{{"colour", "c.png"}, {"height", "h.exr"}}, 1, 8, GreenAxis::down, Tile::x});
  EXPECT_EQ(found["tile"], "x");
  EXPECT_EQ(found["green"], "down");
  EXPECT_EQ(picture(found["maps"]["colour"]), read_image(folder_ / "c.png").image);
  const double range = 199.0 / 50;
  EXPECT_NEAR(found["strength"].get<double>(), 8 * range / 20, 1e-4);
  const Image packed = picture(found["maps"]["height"]);
  ASSERT_EQ(packed.channels, 3);
  for (std::size_t i = 0; i < height.pixels.size(); ++i)
    EXPECT_NEAR(packed.pixels[3 * i] * 255 * 256 + packed.pixels[3 * i + 1] * 255,
                static_cast<double>(i) / 199 * 65535, 1);
}

TEST_F(SurfaceViews, LargePicturesAreReduced) {
  write_image(folder_ / "c.exr", Image(1200, 600, 4, 0.5f), {PixelType::half, "", {}});
  write_image(folder_ / "n.tif", Image(1200, 600, 3, 0.5f), {PixelType::uint16, "", {}});
  const Json found = data({{{"colour", "c.exr"}, {"normal", "n.tif"}}});
  const Image colour = picture(found["maps"]["colour"]);
  EXPECT_EQ(colour.size(), (Size{512, 256}));
  EXPECT_EQ(colour.channels, 3);
  EXPECT_EQ(picture(found["maps"]["normal"]).size(), (Size{512, 256}));
}

TEST_F(SurfaceViews, SignedNormalsOfFloatsAreShownAsColours) {
  Image normals(8, 4, 3);
  for (std::size_t i = 0; i < normals.pixels.size(); i += 3) {
    normals.pixels[i] = -0.6f;
    normals.pixels[i + 2] = 0.8f;
  }
  write_image(folder_ / "c.png", Image(8, 4, 3), {});
  write_image(folder_ / "n.exr", normals, {PixelType::float32, "", {}});
  const Image shown = picture(data({{{"colour", "c.png"}, {"normal", "n.exr"}}})["maps"]["normal"]);
  EXPECT_NEAR(shown.pixels[0], 0.2f, 0.003f);
  EXPECT_NEAR(shown.pixels[1], 0.5f, 0.003f);
  EXPECT_NEAR(shown.pixels[2], 0.9f, 0.003f);
}

TEST_F(SurfaceViews, AreMadeAgainOnlyWhenAFileIsOfAnotherTime) {
  write_image(folder_ / "c.png", Image(4, 4, 3), {});
  const SurfaceView view{{{"colour", "c.png"}}};
  const fs::path script = folder_ / surface_view_file(folder_, "e/q/seed1", view);
  const std::string kept = read_text(script) + "// kept";
  const auto keep = [&] {
    write_text(script, kept);
    fs::last_write_time(script, fs::last_write_time(folder_ / "c.png"));
  };
  keep();
  surface_view_file(folder_, "e/q/seed1", view);
  EXPECT_EQ(read_text(script), kept);
  for (const int hours : {1, -24}) {
    keep();
    fs::last_write_time(folder_ / "c.png", fs::last_write_time(script) + std::chrono::hours(hours));
    surface_view_file(folder_, "e/q/seed1", view);
    EXPECT_NE(read_text(script), kept) << "also where a clock was set back";
  }
  keep();
  surface_view_file(folder_, "e/q/seed1", {{{"colour", "c.png"}}, 1, 8, GreenAxis::down});
  EXPECT_NE(read_text(script), kept) << "one of before knew no green";
}

TEST_F(SurfaceViews, AFileThatIsNotThereIsAnError) {
  EXPECT_THROW(surface_view_file(folder_, "e/q/seed1", {{{"colour", "none.png"}}}), Error);
}

}  // namespace
}  // namespace gramloom
