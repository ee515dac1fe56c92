// [surface]: maps of every result that has a height, made by the job and written beside it.
#include <gmock/gmock.h>

#include "jobs/plan.h"
#include "jobs/run_folder.h"
#include "runs/job_maps.h"
#include "surface/normal_map.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const std::string stone =
    "size = [48, 40]\ntile = 'both'\n"
    "[[method]]\nname = 'stone'\nkind = 'procedural'\ntexture = 'stone_wall'\nsamples = 1\n"
    "[[method]]\nname = 'granite'\nkind = 'procedural'\ntexture = 'granite'\nsamples = 1\n";
const std::string normal = "[surface]\nnormal = true\nstrength = 20\n";

class SurfaceOfJobs : public Runner {
 protected:
  std::string refusal(const std::string& text) const {
    try {
      run_text(text);
    } catch (const ConfigError& error) {
      const std::string line = error.what();
      return line.substr(line.find("c.toml"));
    }
    return "";
  }
  // The exemplar with a height.
  std::string exemplar(int channels) const {
    const Image picture = read_image(folder_ / "e.png").image;
    write_image(folder_ / "h.png", extract_channels(picture, 0, channels),
                {PixelType::uint16, "", {}});
    return "size = [40, 24]\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
           "maps = { height = 'h.png' }\n[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = "
           "8\n";
  }
};

TEST_F(SurfaceOfJobs, ProceduralHeightsGetTheirMaps) {
  ASSERT_EQ(run_text(stone + normal + "occlusion = true\ngreen = 'down'\n").done, 2);
  const JobRecord wall = record("procedural/stone/seed1");
  for (const std::string name : {"seed1_height.png", "seed1_normal.png", "seed1_occlusion.png"})
    EXPECT_NE(std::find(wall.files.begin(), wall.files.end(), name), wall.files.end()) << name;
  const ImageFile height = read_image(out("procedural/stone/seed1_height.png"));
  const ImageFile map = read_image(out("procedural/stone/seed1_normal.png"));
  EXPECT_EQ(map.encoding.pixel_type, height.encoding.pixel_type) << "with steps as fine";
  const Image expected =
      normals_to_colours(normals_from_height(height.image, 20, Tile::both), GreenAxis::down);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    ASSERT_NEAR(map.image.pixels[i], expected.pixels[i], 2e-3);
  EXPECT_EQ(wall.settings["surface"]["strength"], 20);
  EXPECT_EQ(record("procedural/granite/seed1").notes,
            (std::vector<std::string>{"no normal, occlusion: the texture has no map 'height'"}));
}

TEST_F(SurfaceOfJobs, ResumeKnowsThem) {
  run_text(stone + normal);
  EXPECT_EQ(resume(stone + normal).skipped, 2);
  EXPECT_EQ(resume(stone + normal, {"surface.strength=4"}).done, 2) << "another strength";
  fs::remove(out("procedural/stone/seed1_normal.png"));
  EXPECT_EQ(resume(stone + normal, {"surface.strength=4"}).done, 1) << "a map that is gone";
  EXPECT_EQ(resume(stone).done, 2);
  EXPECT_FALSE(fs::exists(out("procedural/stone/seed1_normal.png"))) << "of the result before";
}

// Of what was made from one picture: as high as that is bright, at each scale, and so are its maps.
TEST_F(SurfaceOfJobs, HeightsAreGuessedWhereAnExemplarHasNone) {
  const std::string plain =
      "size = [48, 40]\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "[[method]]\nname = 'b'\nkind = 'quilting'\npatch_size = 8\n"
      "[[method]]\nname = 'granite'\nkind = 'procedural'\ntexture = 'granite'\nsamples = 1\n";
  ASSERT_EQ(run_text(plain + "[surface]\nguess = true\nnormal = true\n").done, 2);
  const JobRecord job = record("e/b/seed1");
  EXPECT_THAT(job.files, testing::UnorderedElementsAre("seed1.png", "seed1_height.png",
                                                       "seed1_normal.png", "seed1_roughness.png"));
  EXPECT_THAT(job.notes, testing::Contains("height: guessed from the colours"));
  EXPECT_EQ(read_image(out("e/b/seed1_height.png")).encoding.pixel_type, PixelType::uint16);
  EXPECT_EQ(record("procedural/granite/seed1").files, (std::vector<std::string>{"seed1.png"}))
      << "what is flat by its formula stays so";
  EXPECT_EQ(resume(plain + "[surface]\nguess = true\nnormal = true\n").skipped, 2);
  ASSERT_EQ(run_text(plain + "[surface]\nguess = true\n").done, 2);
  EXPECT_THAT(
      record("e/b/seed1").files,
      testing::UnorderedElementsAre("seed1.png", "seed1_height.png", "seed1_roughness.png"));
  // One that has a height keeps it.
  const Image picture = read_image(folder_ / "e.png").image;
  write_image(folder_ / "h.png", extract_channels(picture, 0, 1), {PixelType::uint16, "", {}});
  const std::string other = "[[exemplar]]\nname = 'f'\nimage = 'e.png'\n";
  ASSERT_EQ(run_text(exemplar(1) + other + "[surface]\nguess = true\nnormal = true\n").done, 2);
  EXPECT_THAT(record("e/b/seed1").files,
              testing::UnorderedElementsAre("seed1.png", "seed1_height.png", "seed1_normal.png"));
}

TEST_F(SurfaceOfJobs, ExemplarsHeightsToo) {
  ASSERT_EQ(run_text(exemplar(1) + normal).done, 1);
  EXPECT_EQ(record("e/b/seed1").files,
            (std::vector<std::string>{"seed1.png", "seed1_height.png", "seed1_normal.png"}));
  EXPECT_EQ(read_image(out("e/b/seed1_normal.png")).encoding.pixel_type, PixelType::uint16);
  EXPECT_TRUE(record("e/b/seed1").map_metrics->at("height").contains("value_distance"));
}

// A map under another name is the height where the config says so, to maps and previews alike.
TEST_F(SurfaceOfJobs, TheHeightMayHaveAnotherName) {
  const std::string shown =
      "[preview]\nshape = 'plane'\nsize = [40, 30]\nsamples = 1\ndisplacement = 0.1\n";
  std::string text = exemplar(1);
  ASSERT_EQ(run_text(text + normal + shown).done, 1);
  const Image wanted = read_image(out("e/b/seed1_normal.png")).image;
  const Image preview = read_image(out("e/b/seed1_preview.png")).image;
  text.replace(text.find("height ="), 8, "relief =");
  ASSERT_EQ(run_text(text + normal + "height = 'relief'\n" + shown).done, 1);
  EXPECT_EQ(read_image(out("e/b/seed1_normal.png")).image, wanted);
  EXPECT_EQ(read_image(out("e/b/seed1_preview.png")).image, preview);
  EXPECT_EQ(record("e/b/seed1").settings["surface"]["height"], "relief");
  EXPECT_EQ(material_map_of(record("e/b/seed1"), "relief"), "height");
  EXPECT_THAT(refusal(text + normal + "height = 'depth'\n"),
              testing::HasSubstr("no exemplar has a map called 'depth'"));
  EXPECT_EQ(run_text(stone + normal + "height = 'relief'\n").done, 2)
      << "procedural ones have theirs";
  EXPECT_TRUE(fs::exists(out("procedural/stone/seed1_normal.png")));
}

TEST_F(SurfaceOfJobs, PlansKnowWhatMapsAndPreviewsTake) {
  const auto planned = [&](const std::string& more) {
    return make_plan(parse_config(stone + more, folder_ / "c.toml")).jobs.front().finishing;
  };
  const Cost written = planned(""), maps = planned(normal), preview = planned("[preview]\n"),
             fine = planned("[preview]\nsamples = 8\n"), all = planned(normal + "[preview]\n");
  EXPECT_GT(seconds(written.work), 0);
  EXPECT_GT(seconds(maps.work), seconds(written.work));
  EXPECT_GT(maps.bytes, written.bytes);
  EXPECT_GT(seconds(preview.work), 0.5);
  EXPECT_GT(seconds(fine.work), 2 * seconds(preview.work));
  EXPECT_NEAR(seconds(all.work) + seconds(written.work), seconds(maps.work) + seconds(preview.work),
              1e-9);
}

TEST_F(SurfaceOfJobs, MistakesAreOneLineWithTheirPlace) {
  const std::string text = exemplar(3);
  EXPECT_EQ(refusal(text + normal), "c.toml:2:1: " + (folder_ / "h.png").string() +
                                        ": a height map has 3 channels that differ, allowed is 1");
  EXPECT_EQ(run_text(text).done, 1) << "nobody asked";
  EXPECT_EQ(refusal("[surface]\nnormal = true\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                    "[[method]]\nname = 'b'\nkind = 'quilting'\n"),
            "c.toml:1:2: 'surface' makes maps of heights: no exemplar has a map called 'height' "
            "(guess = true guesses heights from the colours)");
  EXPECT_EQ(refusal("[surface]\nnormal = true\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                    "maps = { height = 'h.png', normal = 'e.png' }\n"
                    "[[method]]\nname = 'b'\nkind = 'quilting'\n"),
            "c.toml:1:2: the map 'normal' is the exemplar's own, of 'e': leave one of the two out");
  EXPECT_EQ(refusal(stone + "[surface]\nguess = true\n"),
            "c.toml:13:2: 'guess' has no effect: no method here makes textures of an exemplar");
  EXPECT_EQ(refusal(exemplar(1) + "[surface]\nguess = true\nheight = 'height'\n"),
            "c.toml:10:2: 'guess' has no effect: every exemplar has a height");
  EXPECT_EQ(refusal("[surface]\nguess = true\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                    "maps = { Height = 'h.png' }\n[[method]]\nname = 'b'\nkind = 'quilting'\n"),
            "c.toml:1:2: the map 'Height' of 'e' would have the file of the guessed 'height': "
            "rename it");
  EXPECT_EQ(refusal(stone + "[surface]\nstrength = 0\n"),
            "c.toml:14:1: 'strength' = 0: allowed are 0.001 to 100000");
  EXPECT_EQ(refusal(stone + "[surface]\nnormals = true\n"),
            "c.toml:14:1: unknown key 'normals' (did you mean 'normal'?)");
}

// A user's file under the name of a map is never replaced.
TEST_F(SurfaceOfJobs, AForeignFileUnderAMapsNameIsRefused) {
  run_text(stone);
  write_image(out("procedural/stone/seed1_normal.png"), Image({4, 4}, 3), {});
  EXPECT_THROW(run_text(stone + normal), ConfigError);
}

}  // namespace
}  // namespace gramloom
