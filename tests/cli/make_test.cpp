// `gramloom make`: one texture in one line.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class MakeCommand : public Workspace {
 protected:
  // What `make` with these words writes, and that its printed config leaves the same bytes in
  // `result`.
  void expect_same_bytes(std::vector<std::string> words, const std::string& result) const {
    words.insert(words.begin(), "make");
    words.insert(words.end(), {"--output", "made.png", "--quiet"});
    const Outcome made = run(words);
    ASSERT_EQ(made.exit_code, 0) << made.errors;
    EXPECT_TRUE(made.output.starts_with("made.png\n")) << made.output;
    words.push_back("--print-config");
    const Outcome config = run(words);
    ASSERT_EQ(config.exit_code, 0) << config.errors;
    write_text(folder_ / "p.toml", config.output);
    const Outcome ran = run({"run", "p.toml", "--quiet", "--set", "scores=false"});
    ASSERT_EQ(ran.exit_code, 0) << ran.errors << config.output;
    EXPECT_EQ(file("made.png"), file("out/p/" + result + ".png")) << config.output;
  }
};

TEST_F(MakeCommand, MakesTheBytesThatItsPrintedConfigMakes) {
  expect_same_bytes({"e.png", "--kind", "quilting", "--size", "40,24", "--tile", "x", "--seed", "7",
                     "--set", "patch_size=8"},
                    "e/quilting/seed7");
  expect_same_bytes({"e.png", "--size", "32", "--set", "iterations=[2, 3]", "--set", "levels=2"},
                    "e/neural/seed1");
}

TEST_F(MakeCommand, SeveralPicturesAreOneMaterialAndMapsAreMadeToo) {
  fs::copy_file(folder_ / "e.png", folder_ / "f.png");
  expect_same_bytes({"e.png", "f.png", "--kind", "quilting", "--size", "24", "--set",
                     "patch_size=8", "--max-side", "24"},
                    "e/quilting/seed1");
  write_image(folder_ / "h.png", Image(32, 32, 1, 0.5f), {});
  expect_same_bytes({"e.png", "--kind", "quilting", "--size", "24", "--set", "patch_size=8",
                     "--map", "height=h.png"},
                    "e/quilting/seed1");
  EXPECT_EQ(file("made_height.png"), file("out/p/e/quilting/seed1_height.png"));
}

TEST_F(MakeCommand, FindsTheMapsBesideThePicture) {
  const std::vector<std::string> words{"e.png", "--kind", "quilting",    "--size",
                                       "24",    "--set",  "patch_size=8"};
  write_image(folder_ / "e_height.png", Image(32, 32, 1, 0.5f), {});
  write_image(folder_ / "e_Normal.png", Image(32, 32, 3, 0.5f), {});
  write_image(folder_ / "e_other.png", Image(9, 9, 3, 0.5f), {});
  expect_same_bytes(words, "e/quilting/seed1");
  for (const std::string map : {"height", "normal"})
    EXPECT_EQ(file("made_" + map + ".png"), file("out/p/e/quilting/seed1_" + map + ".png"));
  EXPECT_FALSE(fs::exists(folder_ / "made_other.png"));
  const auto config = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    more.insert(more.begin(), "make");
    more.push_back("--print-config");
    return run(more);
  };
  EXPECT_THAT(config({}).output, HasSubstr("e_Normal.png"));
  EXPECT_THAT(config({"--no-maps"}).output, testing::Not(HasSubstr("maps")));
  const std::string given = config({"--map", "rough=e_height.png"}).output;
  EXPECT_THAT(given, HasSubstr("\"rough\" = "));
  EXPECT_THAT(given, testing::Not(HasSubstr("e_Normal.png"))) << "those that are named, alone";
  write_image(folder_ / "e_rough.png", Image(9, 9, 1, 0.5f), {});
  expect_refused("make", {"e.png", "--kind", "quilting", "--output", "x.png"},
                 "e_rough.png has 9×9 pixels");
  expect_refused("make", {"e.png", "--kind", "quilting", "--output", "x.png"}, "--no-maps");
  fs::remove(folder_ / "e_rough.png");
  EXPECT_EQ(config({"--no-maps", "--map", "rough=e_height.png"}).exit_code, 2);

  std::vector<std::string> quick{"make", "--output", "n.png"};
  quick.insert(quick.end(), words.begin(), words.end());
  EXPECT_THAT(run(quick).errors,
              HasSubstr("with the maps beside e.png: e_height.png, e_Normal.png"));
}

TEST_F(MakeCommand, ANameIsAProceduralTexture) {
  expect_same_bytes({"brick", "--size", "32", "--set", "scale=2"}, "procedural/brick/seed1");
  EXPECT_EQ(file("made_height.png"), file("out/p/procedural/brick/seed1_height.png"));
}

TEST_F(MakeCommand, ScalesPhotographsDownAndSaysSo) {
  write_image(folder_ / "large.png", Image(1100, 40, 3, 0.5f), {});
  const std::vector<std::string> words{"make",   "large.png", "--kind",   "histogram",
                                       "--size", "16",        "--output", "a.png"};
  const Outcome outcome = run(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("1024 pixels"));
  std::vector<std::string> whole = words;
  whole.insert(whole.end(), {"--max-side", "1100"});
  const Outcome other = run(whole);
  ASSERT_EQ(other.exit_code, 0) << other.errors;
  EXPECT_EQ(other.errors, "");
}

// A method that gives what it has when it is stopped gives nothing here.
TEST_F(MakeCommand, LeavesNothingWhenItIsInterrupted) {
  Process process(folder_, {"make", "e.png", "--size", "64", "--set", "iterations=1000000",
                            "--output", "a.png"});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  process.signal(SIGINT);
  EXPECT_EQ(process.wait().exit_code, 130);
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

TEST_F(MakeCommand, MistakesAreOneLineAndExitCode2) {
  write_image(folder_ / "mine.png", Image(8, 8, 1, 0.5f), {});
  write_image(folder_ / "b_height.png", Image(8, 8, 1, 0.5f), {});
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "exemplars"},
      {{"e.png"}, "--output or --print-config"},
      // Of a config that nobody has written, no line is named.
      {{"nothing.png", "--output", "a.png"}, "there is no file nothing.png"},
      {{"nothing", "--output", "a.png"}, "nothing"},
      {{"e.png", "brick", "--output", "a.png"}, "procedural texture stands by itself"},
      {{"e.png", "--output", "e.png"}, "would write over e.png"},
      {{"e.png", "--output", "mine.png"}, "would replace mine.png"},
      {{"brick", "--size", "32", "--output", "b.png"}, "would replace b_height.png"},
      {{"e.png", "--output", "a.xyz"}, "must end with .png"},
      {{"e.png", "--output", "none/a.png"}, "there is no folder"},
      {{"e.png", "--output", "a.png", "--size", "0"}, "--size 0"},
      {{"e.png", "--output", "a.png", "--size", "1,2,3"}, "--size 1,2,3"},
      {{"e.png", "--output", "a.png", "--kind", "pixle"}, "pixle"},
      {{"e.png", "--output", "a.png", "--kind", "pixel", "--preset", "fast"}, "has no presets"},
      {{"brick", "--output", "a.png", "--preset", "fast"}, "has no presets"},
      {{"brick", "--output", "a.png", "--kind", "pixel"},
       "--kind pixel: makes textures of pictures"},
      {{"e.png", "--output", "a.png", "--set", "direction=3"}, "did you mean 'directions'"},
      {{"e.png", "--output", "a.png", "--set", "directions=0"}, "directions"},
      {{"e.png", "--output", "a.png", "--set", "kind=pixel"}, "parameters of the method"},
      {{"e.png", "--output", "a.png", "--map", "height=none.png"}, "none.png"},
      {{"e.png", "e.png", "--output", "a.png", "--map", "height=e.png"}, "of one exemplar"},
  };
  for (const auto& [arguments, message] : cases) expect_refused("make", arguments, message);
  EXPECT_FALSE(fs::exists(folder_ / "a.png"));
}

}  // namespace
}  // namespace gramloom
