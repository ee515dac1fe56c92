// Maps of an exemplar from the command line.
#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class MapsCommand : public Workspace {
 protected:
  // A map that is one minus the exemplar's red.
  MapsCommand() {
    const Image picture = read_image(folder_ / "e.png").image;
    Image map(picture.size(), 1);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) *map.at(x, y) = 1 - *picture.at(x, y);
    write_image(folder_ / "r.png", map, {});
    write_text(folder_ / "maps.toml",
               "size = [40, 24]\ntile = 'both'\n"
               "[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { roughness = 'r.png' }\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
               "[[method]]\nname = 'p'\nkind = 'pixel'\n");
  }
};

TEST_F(MapsCommand, MethodsThatCopyKeepThemRegistered) {
  const Outcome outcome = run({"run", "maps.toml", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const std::string job : {"e/q/seed1", "e/p/seed1"}) {
    EXPECT_EQ(record(job, "out/maps")->files,
              (std::vector<std::string>{"seed1.png", "seed1_roughness.png"}));
    const Image picture = read_image(folder_ / "out/maps" / (job + ".png")).image;
    const Image map = read_image(folder_ / "out/maps" / (job + "_roughness.png")).image;
    ASSERT_EQ(map.size(), picture.size());
    ASSERT_EQ(map.channels, 1);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        ASSERT_NEAR(*map.at(x, y), 1 - *picture.at(x, y), 1e-6) << job << " " << x << ", " << y;
  }
  EXPECT_NE(file("out/maps/index.html").find("e/exemplar_roughness.png"), std::string::npos);
}

TEST_F(MapsCommand, AMapOfAnotherSizeIsOneLineAndExitCode2) {
  write_image(folder_ / "r.png", Image(8, 16, 1), {});
  for (const std::string command : {"run", "check"}) {
    const Outcome outcome = run({command, "maps.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors,
              "maps.toml:3:1: the map r.png has 8×16 pixels and its picture e.png 32×32: they must "
              "be equal\n");
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(MapsCommand, AMapThatIsNotThereIsOneLineAndExitCode2) {
  fs::remove(folder_ / "r.png");
  const Outcome outcome = run({"check", "maps.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors, "maps.toml:6:10: there is no file r.png\n");
}

}  // namespace
}  // namespace gramloom
