#include <gmock/gmock.h>

#include "cli/process.h"
#include "cli/workspace.h"

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

TEST_F(PreviewCommand, TheColoursOfAMaterialFindItsMaps) {
  write_image(folder_ / "wall_colour.png", Image(32, 32, 3, 0.5f), {});
  const Outcome outcome = preview({"wall_colour.png", "--output", "x.png"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("height: wall_height.png"));
}

TEST_F(PreviewCommand, EveryShapeMappingAndLookup) {
  for (const std::string option :
       {"--shape=plane",     "--shape=cube",     "--shape=cylinder",         "--shape=teapot",
        "--mapping=linear",  "--mapping=planar", "--mapping=cylindrical",    "--mapping=polar",
        "--mapping=conical", "--mapping=cube",   "--lookup=nearest",         "--lookup=bicubic",
        "--outside=mirror",  "--outside=colour", "--shading=lambert",        "--shading=phong",
        "--normals=area",    "--normals=flat",   "--background=environment", "--displacement=0.1",
        "--no-ground",       "--repeat=4"})
    EXPECT_EQ(preview({"wall.png", option, "--output", "x.png"}).exit_code, 0) << option;
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

TEST_F(PreviewCommand, AMeshOfAFile) {
  write_text(folder_ / "m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Outcome bare = preview({"wall.png", "--shape", "m.obj", "--output", "x.png"});
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_THAT(bare.errors, HasSubstr("m.obj: the mesh has no texture coordinates"));
  EXPECT_EQ(preview({"wall.png", "--shape", "m.obj", "--mapping", "planar", "--output", "x.png"})
                .exit_code,
            0);
}

TEST_F(PreviewCommand, MistakesAreOneLine) {
  const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& says) {
    arguments.insert(arguments.end(), {"--output", "y.png", "--quiet"});
    const Outcome outcome = preview(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.errors;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(says));
    EXPECT_FALSE(exists(folder_ / "y.png"));
  };
  refused({"wall.png", "--shape", "spher"}, 2, "did you mean 'sphere'?");
  refused({"wall.png", "--shape", "none.obj"}, 1, "none.obj");
  refused({"none.png"}, 1, "none.png");
  refused({"wall.png", "--environment", "wall.png", "--environment-kind", "latlong"}, 1,
          "twice as wide as high");
  refused({"e.png", "--displacement", "0.1"}, 2, "the texture has no map 'height'");
  refused({"wall.png", "--displacement", "9"}, 2, "--displacement: 9 is not");
  refused({"wall.png", "--map", "gloss=wall_height.png"}, 1, "unknown map 'gloss'");
  refused({"wall.png", "e.png", "wall.png"}, 1, "1 or 2 materials, here are 3");
  const std::string before = file("wall.png");
  EXPECT_EQ(preview({"wall.png", "--output", "wall.png"}).exit_code, 2);
  EXPECT_EQ(file("wall.png"), before);
  write_image(folder_ / "small_height.png", Image(8, 8, 1), {});
  refused({"wall.png", "--map", "roughness=small_height.png"}, 1, "they must be alike");
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
  const Outcome bad = run({"run", "p.toml", "--set", "preview.shape=spher"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.errors, HasSubstr("did you mean 'sphere'?"));
}

}  // namespace
}  // namespace gramloom
