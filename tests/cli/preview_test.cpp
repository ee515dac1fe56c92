#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <set>
#include <thread>

#include "cli/process.h"
#include "cli/workspace.h"
#include "surface/shading.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

class PreviewCommand : public Workspace {
 protected:
  PreviewCommand() {
    write_image(folder_ / "wall.png", Image(32, 32, 3, 0.5f), {});
    Image height(32, 32, 1);
    for (std::size_t i = 0; i < height.pixels.size(); ++i)
      height.pixels[i] = static_cast<float>(i % 32) / 32;
    write_image(folder_ / "wall_height.png", height, {});
  }
  Outcome preview(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "preview");
    arguments.insert(arguments.end(), {"--size", "48,32", "--samples", "1"});
    return run(arguments);
  }
  Image made(const std::string& name = "x.png") const { return read_image(folder_ / name).image; }
};

TEST_F(PreviewCommand, ShowsATextureWithTheMapsBesideIt) {
  const Outcome outcome = preview({"wall.png", "--output", "x.png"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "x.png\n");
  EXPECT_THAT(outcome.errors, HasSubstr("height: wall_height.png"));
  EXPECT_EQ(made().size(), (Size{48, 32}));
  EXPECT_EQ(made().channels, 3);
  EXPECT_EQ(preview({"wall.png", "--bump", "0", "--output", "flat.png"}).exit_code, 0);
  EXPECT_NE(made(), made("flat.png"));
}

TEST_F(PreviewCommand, GreenIsAsTheNormalsOwnFileSays) {
  Image up(32, 32, 3, 0.5f), down = up;
  for (std::size_t i = 1; i < up.pixels.size(); i += 3) {
    up.pixels[i] = 0.5f + 0.3f;
    down.pixels[i] = 0.5f - 0.3f;
    up.pixels[i + 1] = down.pixels[i + 1] = 0.5f + 0.4f;
  }
  write_image(folder_ / "up.png", up, {PixelType::uint16, "", {}});
  write_image(folder_ / "wall_dx.png", down, {PixelType::uint16, "", {}});
  const auto shown = [&](std::vector<std::string> more) {
    more.insert(more.begin(), "wall.png");
    more.insert(more.end(), {"--shape", "plane", "--output", "x.png"});
    EXPECT_EQ(preview(more).exit_code, 0);
    return made();
  };
  const Image wanted = shown({"--map", "normal=up.png"});
  EXPECT_EQ(shown({"--map", "normal=wall_dx.png"}), wanted);
  EXPECT_NE(shown({"--map", "normal=wall_dx.png", "--green", "up"}), wanted);
  const std::vector<std::string> maps{"maps", "wall_height.png", "--normal", "--strength",
                                      "8",    "--pixel-type",    "uint16"};
  ASSERT_EQ(run(maps).exit_code, 0);
  const Image made_up = shown({});
  auto down_too = maps;
  down_too.insert(down_too.end(), {"--green", "down"});
  ASSERT_EQ(run(down_too).exit_code, 0);
  const Image made_down = shown({});
  for (std::size_t i = 0; i < made_up.pixels.size(); ++i)
    ASSERT_NEAR(made_down.pixels[i], made_up.pixels[i], 1.01f / 255)
        << "maps that the program made say it in their file";
}

TEST_F(PreviewCommand, TheColoursOfAMaterialFindItsMaps) {
  write_image(folder_ / "wall_colour.png", Image(32, 32, 3, 0.5f), {});
  const Outcome outcome = preview({"wall_colour.png", "--output", "x.png"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("height: wall_height.png"));
}

TEST_F(PreviewCommand, EveryShapeMappingAndLookup) {
  // Several at once, of different kinds: most of a preview is the start of the program.
  for (std::vector<std::string> options : std::vector<std::vector<std::string>>{
           {"--shape=plane", "--mapping=linear", "--lookup=nearest", "--outside=mirror",
            "--shading=lambert", "--normals=area"},
           {"--shape=cube", "--mapping=planar", "--lookup=bicubic", "--outside=colour",
            "--shading=phong", "--normals=flat"},
           {"--shape=cylinder", "--mapping=cylindrical", "--background=environment"},
           {"--shape=teapot", "--mapping=polar", "--no-ground"},
           {"--mapping=conical", "--displacement=0.1"},
           {"--mapping=cube", "--repeat=4"}}) {
    options.insert(options.begin(), "wall.png");
    options.insert(options.end(), {"--output", "x.png"});
    const Outcome outcome = preview(options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  }
  EXPECT_EQ(preview({"wall.png", "--background", "transparent", "--output", "x.png"}).exit_code, 0);
  EXPECT_EQ(made().channels, 4);
}

TEST_F(PreviewCommand, ProceduralTexturesByName) {
  EXPECT_EQ(preview({"marble", "wood", "--mapping", "solid", "--output", "x.png"}).exit_code, 0);
  EXPECT_EQ(preview({"brick", "--shape", "cube", "--output", "x.png"}).exit_code, 0);
  EXPECT_EQ(
      preview({"wood", "--mapping=solid", "--set", "cut=flat", "--output", "x.png"}).exit_code, 0);
  const Outcome flat = preview({"brick", "--mapping", "solid", "--output", "y.png"});
  EXPECT_EQ(flat.exit_code, 2);
  EXPECT_THAT(flat.errors, HasSubstr("texture 'brick' has 2 dimensions"));
  const Outcome unknown = preview({"marbel", "--output", "y.png"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("did you mean 'marble'?"));
}

// The most that two pictures differ by in a value, and in the mean of a block of 8×8 pixels.
std::pair<float, float> most_different(const Image& a, const Image& b) {
  EXPECT_EQ(a.size(), b.size());
  float most = 0, of_blocks = 0;
  for (int top = 0; top < a.height; top += 8)
    for (int left = 0; left < a.width; left += 8)
      for (int c = 0; c < a.channels; ++c) {
        float sum = 0;
        for (int y = top; y < top + 8; ++y)
          for (int x = left; x < left + 8; ++x) {
            const float difference = a.at(x, y)[c] - b.at(x, y)[c];
            most = std::max(most, std::abs(difference));
            sum += difference / 64;
          }
        of_blocks = std::max(of_blocks, std::abs(sum));
      }
  return {most, of_blocks};
}

// A procedural texture is made as large as the preview needs it: that is its picture of that size,
// and a larger one looks the same but for its finest details: bevels and mortar are a pixel wide.
TEST_F(PreviewCommand, AProceduralTextureIsThatOfItsPicture) {
  const auto preview_of = [&](const std::string& what) {
    EXPECT_EQ(
        run({"preview", what, "--size", "64,48", "--samples", "4", "--output", "x.png"}).exit_code,
        0);
    return made();
  };
  for (const std::string name : {"brick", "marble"}) {
    const Image own = preview_of(name);
    for (const int side : {128, 512}) {
      const std::string file = fmt::format("{}_of_{}.png", name, side);
      ASSERT_EQ(run({"make", name, "--size", std::to_string(side), "--output", file}).exit_code, 0);
      const auto [most, of_blocks] = most_different(own, preview_of(file));
      EXPECT_LE(most, side == 128 ? 2.01f / 255 : 1.0f) << name << ": the same but for 8 bits";
      EXPECT_LE(of_blocks, 10.0f / 255) << name << " of " << side;
    }
  }
}

TEST_F(PreviewCommand, AMeshOfAFile) {
  write_text(folder_ / "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome bare = preview({"wall.png", "--shape", "m.obj", "--output", "x.png"});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_THAT(bare.errors, HasSubstr("m.obj: the mesh has no texture coordinates"));
  EXPECT_EQ(preview({"wall.png", "--shape", "m.obj", "--mapping", "planar", "--output", "x.png"})
                .exit_code,
            0);
}

TEST_F(PreviewCommand, MistakesAreOneLine) {
  const auto refused = [&](std::vector<std::string> arguments, const std::string& says,
                           const std::string& output = "y.png") {
    arguments.insert(arguments.end(), {"--output", output, "--quiet"});
    const Outcome outcome = preview(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.errors;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(says));
    EXPECT_FALSE(exists(folder_ / output) && output.starts_with("y"));
  };
  refused({"wall.png", "--shape", "spher"}, "did you mean 'sphere'?");
  refused({"wall.png", "--shape", "none.obj"}, "none.obj");
  refused({"none.png"}, "none.png");
  refused({"wall.png", "--environment", "wall.png", "--environment-kind", "latlong"},
          "twice as wide as high");
  refused({"wall.png", "--environment", "wall.png", "--environment", "wall.png"},
          "environment has 2 files");
  refused({"e.png", "--displacement", "0.1"}, "the texture has no map 'height'");
  refused({"marble", "--mapping", "solid", "--displacement", "0.1"},
          "a solid has no height map to displace it");
  refused({"wall.png", "--displacement", "9"}, "--displacement: 9 is not");
  refused({"wall.png", "--map", "gloss=wall_height.png"}, "unknown map 'gloss'");
  refused({"wall.png", "--map", "wall_height.png"}, "needed is NAME=FILE");
  refused({"wall.png", "e.png", "wall.png"}, "1 or 2 materials, here are 3");
  write_image(folder_ / "small_height.png", Image(8, 8, 1), {});
  refused({"wall.png", "--map", "roughness=small_height.png"}, "they must be alike");
  // What has no effect.
  refused({"wall.png", "--set", "scale=3"}, "--set scale=3: has no effect, wall.png is no");
  refused({"wall.png", "e.png", "--mapping", "solid", "--map", "height=wall_height.png"},
          "--map height: has no effect on a solid");
  refused({"brick", "--map", "height=wall_height.png"},
          "--map height: has no effect on the procedural texture 'brick'");
  refused({"wall.png", "--mapping-size", "3"},
          "mapping_size: has no effect with mapping = \"own\"");
  refused({"marble", "--mapping", "solid", "--repeat", "3"}, "repeat: has no effect");
  refused({"wood", "--mapping", "solid", "--set", "tilt=45"},
          "--set tilt: has no effect on a solid");
  refused({"e.png", "--bump", "0.3"}, "bump = 0.3: there is no map 'height' of e.png");
  refused({"wall.png", "--bump", "0.3", "--map", "normal=wall.png"}, "normals have no effect");
  // Where the picture cannot be written.
  refused({"wall.png"}, "--output y.xyz: ", "y.xyz");
  refused({"wall.png", "--background", "transparent"}, "--output y.jpg: ", "y.jpg");
  refused({"wall.png"}, "there is no folder none", "none/y.png");
  create_directories(folder_ / "folder.png");
  refused({"wall.png"}, "is a folder", "folder.png");
  EXPECT_THAT(preview({"marbel", "--output", "y.png"}).errors,
              testing::StartsWith("unknown texture 'marbel' (did you mean 'marble'?)"));
  const Outcome size = run({"preview", "wall.png", "--size", "0x9", "--output", "y.png"});
  EXPECT_EQ(size.exit_code, 2);
  EXPECT_THAT(size.errors, testing::StartsWith("--size 0x9: needed is SIDE|WIDTHxHEIGHT"));
  const std::string before = file("wall.png");
  refused({"wall.png"}, "would write over wall.png", "wall.png");
  EXPECT_EQ(file("wall.png"), before);
}

TEST_F(PreviewCommand, SixFacesAreASkyBox) {
  Image strip(96, 16, 3);
  std::vector<std::string> command{"wall.png", "--metalness", "1", "--roughness", "0"};
  std::vector<std::string> whole = command;
  for (int face = 0; face < 6; ++face) {
    Image picture(16, 16, 3);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c)
          strip.at(16 * face + x, y)[c] = picture.at(x, y)[c] =
              static_cast<float>((face + 1) * (c + 2) * (x + 3) % 17) / 17;
    const std::string name = "face" + std::to_string(face) + ".png";
    write_image(folder_ / name, picture, {});
    command.insert(command.end(), {"--environment", name});
  }
  write_image(folder_ / "strip.png", strip, {});
  whole.insert(whole.end(), {"--environment", "strip.png", "--output", "whole.png"});
  command.insert(command.end(), {"--output", "x.png"});
  EXPECT_EQ(preview(whole).exit_code, 0);
  const Outcome outcome = preview(command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(made(), made("whole.png"));
  write_image(folder_ / "face3.png", Image(16, 8, 3), {});
  const Outcome refused = preview(command);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("face 4 of the sky box has 16×8 pixels"));
}

TEST_F(PreviewCommand, RepeatsWithoutRepetition) {
  const std::vector<std::string> floor{"e.png", "--shape", "plane", "--repeat", "6"};
  auto straight = floor, stochastic = floor;
  straight.insert(straight.end(), {"--output", "straight.png"});
  stochastic.insert(stochastic.end(),
                    {"--stochastic", "--stochastic-rotation", "90", "--output", "x.png"});
  EXPECT_EQ(preview(straight).exit_code, 0);
  const Outcome outcome = preview(stochastic);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(made(), made("straight.png"));
}

// One Ctrl-C ends a preview, and leaves nothing of it.
TEST_F(PreviewCommand, AnInterruptedOneLeavesNoFile) {
  Process process(folder_, {"preview", "wall.png", "--size", "4096", "--samples", "8", "--quiet",
                            "--output", "x.png"});
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  process.signal(SIGINT);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("interrupted; nothing is written"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_EQ(entry.path().filename().string().find("x.png"), std::string::npos) << entry.path();
}

TEST_F(PreviewCommand, AReliefIsThatOfTheHeightsNotOfNormalsBesideThem) {
  write_image(folder_ / "wall_normal.png", Image(32, 32, 3, 0.5f), {});
  ASSERT_EQ(preview({"wall.png", "--output", "normal.png", "--quiet"}).exit_code, 0);
  for (const auto& [bump, name] : {std::pair("0.3", "high.png"), {"0.1", "low.png"}}) {
    const Outcome outcome = preview({"wall.png", "--bump", bump, "--output", name});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_THAT(outcome.errors, testing::Not(HasSubstr("wall_normal.png")));
  }
  EXPECT_NE(file("high.png"), file("low.png"));
  EXPECT_NE(file("low.png"), file("normal.png"));
}

TEST_F(PreviewCommand, AnExrHoldsTheLightItself) {
  for (const char* const name : {"x.png", "x.exr"})
    ASSERT_EQ(preview({"wall.png", "--background", "transparent", "--light-strength", "8",
                       "--output", name, "--quiet"})
                  .exit_code,
              0);
  const Image seen = made(), light = made("x.exr");
  ASSERT_EQ(light.channels, 4);
  float brightest = 0;
  for (std::size_t i = 0; i < light.pixels.size(); i += 4) {
    if (light.pixels[i + 3] < 1) continue;
    brightest = std::max(brightest, light.pixels[i]);
    if (light.pixels[i] >= 0.75f) continue;
    ASSERT_NEAR(seen.pixels[i], srgb_from_linear(light.pixels[i]), 0.01f);
  }
  EXPECT_GT(brightest, 1.5f);
}

TEST_F(PreviewCommand, ASolidIsTurnedAndMovedByTheMapping) {
  std::set<std::string> pictures;
  const std::vector<std::vector<std::string>> ways{
      {}, {"--pole", "1,0,0"}, {"--mapping-size", "6"}, {"--mapping-origin", "0.3,0.2,0.1"}};
  for (std::vector<std::string> way : ways) {
    way.insert(way.begin(), {"wood", "--mapping", "solid"});
    way.insert(way.end(), {"--output", "x.png", "--quiet"});
    ASSERT_EQ(preview(way).exit_code, 0);
    pictures.insert(file("x.png"));
  }
  EXPECT_EQ(pictures.size(), ways.size());
}

// Before the first job, and by `check` too.
TEST_F(PreviewCommand, AConfigsMeshAndSurroundingsAreLookedInto) {
  write_text(folder_ / "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  write_text(folder_ / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string head =
      "size = 16\n[[method]]\nname = 'm'\nkind = 'procedural'\ntexture = "
      "'noise'\n[preview]\nsamples = 1\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"shape = 'nan.obj'", "nan.obj:3: 'nan' is not a finite number"},
      {"shape = 'bare.obj'", "the mesh has no texture coordinates"},
      {"environment = 'e.png'\nenvironment_kind = 'latlong'", "twice as wide as high"},
      {"pattern = 'stripes'", "'pattern' has no effect"}};
  for (const auto& [line, says] : cases) {
    write_text(folder_ / "p.toml", head + line + "\n");
    for (const std::string command : {"check", "run"}) {
      const Outcome outcome = run({command, "p.toml"});
      EXPECT_EQ(outcome.exit_code, 2) << line;
      EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
      EXPECT_THAT(outcome.errors, HasSubstr(says));
      EXPECT_THAT(outcome.errors, HasSubstr("p.toml"));
    }
  }
  EXPECT_FALSE(exists(folder_ / "out/p"));
}

// A texture that the preview does not suit is made, and told of.
TEST_F(PreviewCommand, WhyThereIsNoPreviewIsSaidOnce) {
  write_text(folder_ / "p.toml",
             "size = 16\nseeds = [1, 2]\nscores = false\n[[method]]\nname = 'm'\n"
             "kind = 'procedural'\ntexture = 'granite'\n"
             "[preview]\nsamples = 1\ndisplacement = 0.1\n");
  const Outcome outcome = run({"run", "p.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string note = "note: procedural/m/seed1: no preview: ";
  EXPECT_THAT(outcome.errors, HasSubstr(note));
  EXPECT_THAT(outcome.errors, testing::Not(HasSubstr("note: procedural/m/seed2")));
}

TEST_F(PreviewCommand, AConfigShowsEveryResult) {
  write_text(folder_ / "p.toml",
             "size = 32\ntile = 'both'\nscores = false\n"
             "[[method]]\nname = 'm'\nkind = 'procedural'\ntexture = 'pebbles'\n"
             "[preview]\nshape = 'cube'\nsize = [40, 30]\nsamples = 1\ndisplacement = 0.05\n");
  const Outcome outcome = run({"run", "p.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto done = record("procedural/m/seed1", "out/p");
  ASSERT_TRUE(done);
  EXPECT_THAT(done->files, testing::Contains("seed1_preview.png"));
  EXPECT_EQ(made("out/p/procedural/m/seed1_preview.png").size(), (Size{40, 30}));
  EXPECT_EQ(done->settings.at("preview").at("shape"), "cube");
  // What it is made with counts: another shape is another result.
  const Outcome again = run({"run", "p.toml", "--quiet", "--resume", "--set", "preview.samples=2"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(record("procedural/m/seed1", "out/p")->settings.at("preview").at("samples"), 2);
  // Surroundings of one file or of six.
  write_image(folder_ / "sky.png", Image(16, 16, 3, 0.7f), {});
  const std::string six = "['sky.png', 'sky.png', 'sky.png', 'sky.png', 'sky.png', 'sky.png']";
  for (const std::string& sky : {std::string("'sky.png'"), six}) {
    const Outcome lit = run({"run", "p.toml", "--quiet", "--set", "preview.environment=" + sky});
    EXPECT_EQ(lit.exit_code, 0) << lit.errors;
    EXPECT_THAT(record("procedural/m/seed1", "out/p")->files,
                testing::Contains("seed1_preview.png"));
  }
  const Outcome bad = run({"run", "p.toml", "--set", "preview.shape=spher"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.errors, HasSubstr("did you mean 'sphere'?"));
}

}  // namespace
}  // namespace gramloom
