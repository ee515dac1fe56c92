// `gramloom tile` from the command line.
#include <gmock/gmock.h>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class TileCommand : public Workspace {
 protected:
  // A map that is one minus the exemplar's red.
  TileCommand() {
    const Image picture = read_image(folder_ / "e.png").image;
    Image map(picture.size(), 1);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) *map.at(x, y) = 1 - *picture.at(x, y);
    write_image(folder_ / "r.png", map, {PixelType::uint16, "", {}});
  }
};

TEST_F(TileCommand, ThePictureIsTheMethodsOwn) {
  const Outcome outcome = run({"tile", "e.png", "--size", "200x150", "--output", "floor.png",
                               "--seed", "3", "--sharpness", "2", "--tile", "both", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "floor.png\n");
  EXPECT_EQ(outcome.errors, "");
  write_text(folder_ / "t.toml",
             "size = [200, 150]\nseeds = [3]\ntile = 'both'\n"
             "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "[[method]]\nname = 't'\nkind = 'tiling'\nsharpness = 2\n");
  ASSERT_EQ(run({"run", "t.toml", "--quiet"}).exit_code, 0);
  EXPECT_EQ(read_image(folder_ / "floor.png").image,
            read_image(folder_ / "out/t/e/t/seed3.png").image);
  EXPECT_THAT(read_image(folder_ / "floor.png").metadata.at("gramloom:settings"),
              HasSubstr("\"sharpness\":2"));
}

TEST_F(TileCommand, MapsLieBesideItWithTheirOwnBits) {
  const Outcome outcome = run({"tile", "e.png", "--map", "roughness=r.png", "--size", "130",
                               "--output", "floor.tif", "--blend", "contrast"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "floor.tif\nfloor_roughness.tif\n");
  const Image picture = read_image(folder_ / "floor.tif").image;
  const ImageFile map = read_image(folder_ / "floor_roughness.tif");
  EXPECT_EQ(map.encoding.pixel_type, PixelType::uint16);
  ASSERT_EQ(map.image.size(), (Size{130, 130}));
  for (int y = 0; y < 130; ++y)
    for (int x = 0; x < 130; ++x) ASSERT_NEAR(*map.image.at(x, y), 1 - *picture.at(x, y), 0.003f);
}

TEST_F(TileCommand, AFileOfTheUserIsNotTakenForAnOlderMap) {
  write_image(folder_ / "floor_roughness.png", Image(8, 8, 1, 0.5f), {});
  const std::string before = file("floor_roughness.png");
  const std::vector<std::string> command{"tile",   "e.png", "--map",    "roughness=r.png",
                                         "--size", "64",    "--output", "floor.png"};
  EXPECT_EQ(run(command).exit_code, 2);
  EXPECT_EQ(file("floor_roughness.png"), before);
  fs::remove(folder_ / "floor_roughness.png");
  EXPECT_EQ(run(command).exit_code, 0);
  EXPECT_EQ(run(command).exit_code, 0);  // its own are replaced
}

TEST_F(TileCommand, AnEmptyNameIsAnError) {
  const Outcome outcome = run({"tile", "", "--size", "64", "--output", "a.png"});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
}

TEST_F(TileCommand, MistakesAreOneLineAndExitCode2) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"e.png", "--size", "10x", "--output", "a.png"},
       "--size 10x: needed is SIDE|WIDTHxHEIGHT, each from 1 to 1000000 pixels"},
      {{"e.png", "--size", "0", "--output", "a.png"}, "--size 0"},
      {{"e.png", "--size", "9999999x2", "--output", "a.png"}, "1000000"},
      {{"e.png", "--size", "64", "--output", "e.png"}, "would write over e.png, which is to be"},
      {{"e.png", "--size", "64", "--map", "r=r.png", "--output", "a.xyz"}, "extension '.xyz'"},
      {{"e.png", "--size", "64", "--map", "r.png", "--output", "a.png"}, "needed is NAME=FILE"},
      {{"e.png", "--size", "64", "--cell", "2", "--output", "a.png"}, "--cell"},
      {{"e.png", "--size", "64", "--period", "3", "--output", "a.png"}, "period has 1 numbers"},
      {{"e.png", "--size", "70000x8", "--output", "a.jpg"}, "a side has at most 65500"},
      {{"e.png", "--output", "a.png"}, "tile: needed is '--size'"}};
  for (const auto& [arguments, message] : cases) expect_refused("tile", arguments, message);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.png"));
}

TEST_F(TileCommand, AMapOfAnotherSizeIsRefused) {
  write_image(folder_ / "r.png", Image(8, 16, 1), {});
  const Outcome outcome =
      run({"tile", "e.png", "--map", "r=r.png", "--size", "64", "--output", "a.png"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("8×16 pixels and its picture e.png 32×32"));
}

}  // namespace
}  // namespace gramloom
