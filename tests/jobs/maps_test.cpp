// Exemplars with maps: read with the picture, made with it, written beside it.
#include <gtest/gtest.h>

#include "jobs/plan.h"
#include "jobs/run_folder.h"
#include "metrics/scores.h"
#include "signal/resize.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const std::string with_maps =
    "size = [40, 24]\n"
    "[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { height = 'h.png', flow = 'flow.exr' }\n"
    "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n";

// The exemplar with a height (16 bits) and a flow (two half floats) that its colours tell.
class Maps : public Runner {
 protected:
  Maps() { write_maps(1); }

  void write_maps(float scale) const {
    const Image picture = read_image(folder_ / "e.png").image;
    Image height(picture.size(), 1);
    Image flow(picture.size(), 2);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const float* colour = picture.at(x, y);
        *height.at(x, y) = scale * colour[0] * colour[0];
        flow.at(x, y)[0] = 3 - 8 * colour[1];
        flow.at(x, y)[1] = colour[2];
      }
    write_image(folder_ / "h.png", height, {PixelType::uint16, "", {"height"}});
    write_image(folder_ / "flow.exr", flow, {PixelType::half, "", {"u", "v"}});
  }

  // What a map's file holds where a channel of the picture has a value.
  using Relation = std::map<float, std::vector<float>>;
  static Relation relation(const fs::path& picture_file, int channel, const fs::path& map_file) {
    const Image picture = read_image(picture_file).image;
    const Image map = read_image(map_file).image;
    EXPECT_EQ(map.size(), picture.size());
    Relation found;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const std::vector<float> values(map.at(x, y), map.at(x, y) + map.channels);
        const auto [at, fresh] = found.emplace(picture.at(x, y)[channel], values);
        EXPECT_EQ(at->second[0], values[0]) << "not registered at " << x << ", " << y;
      }
    return found;
  }
  static void expect_within(const Relation& result, const Relation& exemplar) {
    EXPECT_GT(result.size(), 50u);
    for (const auto& [value, map] : result) {
      ASSERT_TRUE(exemplar.contains(value)) << value;
      EXPECT_EQ(map[0], exemplar.at(value)[0]) << value;
    }
  }

  std::string refusal(const std::string& text) const {
    try {
      run_text(text);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Maps, StayRegisteredAndKeepTheirFilesEncoding) {
  EXPECT_EQ(run_text(with_maps).done, 1);
  EXPECT_EQ(record("e/b/seed1").files,
            (std::vector<std::string>{"seed1.png", "seed1_flow.exr", "seed1_height.png"}));
  const ImageFile picture = read_image(out("e/b/seed1.png"));
  EXPECT_EQ(picture.image.channels, 3);
  EXPECT_EQ(picture.encoding.pixel_type, PixelType::uint8);
  const ImageFile height = read_image(out("e/b/seed1_height.png"));
  EXPECT_EQ(height.image.channels, 1);
  EXPECT_EQ(height.encoding,
            (Encoding{PixelType::uint16, height.encoding.colour_space, {"height"}}));
  const ImageFile flow = read_image(out("e/b/seed1_flow.exr"));
  EXPECT_EQ(flow.encoding.pixel_type, PixelType::half);
  EXPECT_EQ(flow.encoding.channel_names, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(
      Json::parse(height.metadata.at("gramloom:settings"))["exemplar"]["maps"]["height"]["image"],
      "h.png");

  expect_within(relation(out("e/b/seed1.png"), 0, out("e/b/seed1_height.png")),
                relation(folder_ / "e.png", 0, folder_ / "h.png"));
  expect_within(relation(out("e/b/seed1.png"), 1, out("e/b/seed1_flow.exr")),
                relation(folder_ / "e.png", 1, folder_ / "flow.exr"));
}

TEST_F(Maps, TheExemplarsOwnLieBesideItsPicture) {
  run_text(with_maps, {}, {"exemplar.e.max_side=20"});
  EXPECT_EQ(read_image(out("e/exemplar.png")).image.channels, 3);
  const Image expected = fit_longer_side(read_image(folder_ / "h.png").image, 20);
  const Image kept = read_image(out("e/exemplar_height.png")).image;
  ASSERT_EQ(kept.size(), (Size{20, 20}));
  for (std::size_t i = 0; i < kept.pixels.size(); ++i)
    EXPECT_NEAR(kept.pixels[i], expected.pixels[i], 1.0 / 65535);
  EXPECT_EQ(read_image(out("e/exemplar_flow.exr")).image.channels, 2);
}

TEST_F(Maps, ScoresAreThoseOfThePictureAlone) {
  run_text(with_maps);
  const Scores expected = score(read_image(folder_ / "e.png").image,
                                read_image(out("e/b/seed1.png")).image, Tile::none);
  ASSERT_FALSE(expected.values.empty());
  for (const auto& [name, value] : expected.values)
    EXPECT_EQ(record("e/b/seed1").metrics.at(std::string(name)), value) << name;
}

TEST_F(Maps, AChangedMapMeansTheJobAgain) {
  run_text(with_maps);
  EXPECT_EQ(resume(with_maps).skipped, 1);
  write_maps(0.5f);
  EXPECT_EQ(resume(with_maps).done, 1) << "another file";
  EXPECT_EQ(resume(with_maps).skipped, 1);
  EXPECT_EQ(resume(with_maps, {"exemplar.e.maps={}"}).done, 1) << "no maps";
  EXPECT_FALSE(fs::exists(out("e/b/seed1_height.png"))) << "of the result before";
  fs::remove(out("e/b/seed1.json"));
  EXPECT_EQ(resume(with_maps).done, 1);
  fs::remove(out("e/b/seed1_flow.exr"));
  EXPECT_EQ(resume(with_maps).done, 1) << "a map that is gone";
}

TEST_F(Maps, CountInTheEstimateOfMemory) {
  const auto bytes = [&](const std::vector<std::string>& set) {
    return make_plan(parse_config(with_maps, folder_ / "c.toml", set)).jobs.at(0).cost.bytes;
  };
  EXPECT_GT(bytes({}), bytes({"exemplar.e.maps={}"}));
}

TEST_F(Maps, OfAnotherSizeAreRefusedInOneLineThatNamesBoth) {
  write_image(folder_ / "h.png", Image(16, 8, 1), {});
  const std::string line = refusal(with_maps);
  EXPECT_TRUE(line.starts_with((folder_ / "c.toml:2:1: ").string())) << line;
  for (const std::string part : {"h.png has 16×8", "e.png 32×32"})
    EXPECT_NE(line.find(part), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST_F(Maps, MistakesInTheTableAreFoundWithTheirPlace) {
  const auto with = [&](const std::string& maps) {
    std::string line = refusal("[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = " + maps +
                               "\n[[method]]\nname = 'b'\nkind = 'quilting'\n");
    const std::string folder = folder_.string() + "/";
    for (auto at = line.find(folder); at != std::string::npos; at = line.find(folder))
      line.erase(at, folder.size());
    return line;
  };
  EXPECT_EQ(with("{ height = 'no.png' }"), "c.toml:4:10: there is no file no.png");
  EXPECT_EQ(with("{ height = 3 }"), "c.toml:4:10: 'height' is a whole number, allowed is a file");
  EXPECT_EQ(with("{ height = '' }"), "c.toml:4:1: the map 'height' has no file");
  EXPECT_EQ(with("{ 'a/b' = 'h.png' }"), "c.toml:4:1: name 'a/b' is not fit for a file name");
  EXPECT_EQ(with("{ '' = 'h.png' }"), "c.toml:4:1: a name is empty");
  EXPECT_EQ(with("'h.png'"),
            "c.toml:4:1: 'maps' is a text, allowed is a table of files: { name = \"file.png\" }");
}

TEST_F(Maps, ThatCannotBeReadFailTheirJobsOnly) {
  write_text(folder_ / "h.png", "no picture");
  EXPECT_EQ(run_text(with_maps).failed, 1);
  EXPECT_NE(record("e/b/seed1").error.find("h.png"), std::string::npos);
}

}  // namespace
}  // namespace gramloom
