// `gramloom pick`: results of a run in a folder of their own, with configs that make them again.
#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PickCommand : public Workspace {
 protected:
  void make_run(const std::string& config) const {
    write_text(folder_ / "c.toml", config);
    const Outcome outcome = run({"run", "c.toml", "--quiet", "--set", "scores=false"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  }
  // The config of a picked picture leaves its bytes, wherever it is run.
  void expect_made_again(const std::string& job) const {
    const std::string name = fs::path(job).filename().string();
    fs::create_directories(folder_ / "else");
    const Outcome again = gramloom(
        folder_ / "else", {"run", "../picked/" + job + ".toml", "--quiet", "--output", "again"});
    ASSERT_EQ(again.exit_code, 0) << again.errors << file("picked/" + job + ".toml");
    for (const auto& entry : fs::directory_iterator((folder_ / "picked" / job).parent_path()))
      if (entry.path().extension() == ".png" &&
          entry.path().filename().string().starts_with(name)) {
        const std::string picture =
            (fs::path(job).parent_path() / entry.path().filename()).string();
        EXPECT_TRUE(file("picked/" + picture) == file("else/again/" + picture)) << picture;
        EXPECT_TRUE(file("picked/" + picture) == file("out/c/" + picture)) << picture;
      }
    fs::remove_all(folder_ / "else");
  }
};

TEST_F(PickCommand, CopiesPicturesAndTheirMapsWithAConfigEach) {
  write_image(folder_ / "h.png", Image(32, 32, 1, 0.5f), {});
  fs::copy_file(folder_ / "e.png", folder_ / "f.png");
  make_run(
      "seeds = [1, 2]\nsize = [40, 24]\ntile = 'x'\n[[exemplar]]\nname = \"it's 100% #1\"\n"
      "image = 'e.png'\nmax_side = 24\nmaps = { height = 'h.png', wet = { image = 'h.png', kind = "
      "'scalar' } }\n[[exemplar]]\nname = 'f'\nimages = ['e.png', 'f.png']\n"
      "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
      "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'brick'\n"
      "[surface]\nnormal = true\n");
  const std::string odd = "it's 100% #1/q/seed2", stone = "procedural/n/seed1", both = "f/q/seed1";
  write_text(folder_ / "list.txt", stone + "\r\n\n" + both + "\n");
  const Outcome outcome = run({"pick", "out/c", odd, "--list", "list.txt", "--output", "picked"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output,
            "picked/" + odd + ".png\npicked/" + stone + ".png\npicked/" + both + ".png\n");
  EXPECT_TRUE(fs::exists(folder_ / "picked" / (odd + "_normal.png")));
  EXPECT_FALSE(fs::exists(folder_ / "picked/f/q/seed2.png"));
  for (const std::string& job : {odd, stone, both}) expect_made_again(job);

  // Picked anew: what is no longer picked goes, what is not ours stays.
  write_text(folder_ / "picked/notes.txt", "mine");
  ASSERT_EQ(run({"pick", "out/c", both, "--output", "picked"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "picked" / (odd + ".png")));
  EXPECT_FALSE(fs::exists(folder_ / "picked" / (odd + ".toml")));
  EXPECT_TRUE(fs::exists(folder_ / "picked" / (both + ".toml")));
  EXPECT_TRUE(fs::exists(folder_ / "picked/notes.txt"));
}

TEST_F(PickCommand, NeuralAndSetAndAConfigThatHasGrown) {
  make_run(
      "size = 32\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "[[method]]\nname = 'q'\nkind = 'quilting'\n"
      "[[method]]\nname = 'm'\nkind = 'neural'\npreset = 'fast'\niterations = [2, 3]\n"
      "levels = 2\n");
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--only", "e/q", "--set", "patch_size=9"}).exit_code,
            0);
  // The run's file knows the grown config alone; the jobs are as they were.
  write_text(folder_ / "c.toml", file("c.toml") + "[[method]]\nname = 'x'\nkind = 'phase'\n");
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--only", "e/x"}).exit_code, 0);
  const Outcome outcome = run({"pick", "out/c", "e/q/seed1", "e/m/seed1", "--output", "picked"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(file("picked/e/q/seed1.toml"), HasSubstr("patch_size = 9\n"));
  EXPECT_THAT(file("picked/e/m/seed1.toml"), HasSubstr("--threads "));
  expect_made_again("e/q/seed1");
  expect_made_again("e/m/seed1");
}

TEST_F(PickCommand, MistakesAreOneLineAndExitCode2) {
  make_run(file("c.toml"));
  const auto refused = [&](std::vector<std::string> words, const std::string& says) {
    expect_refused("pick", words, says);
  };
  refused({"out/c", "e/q/seed3", "--output", "picked"}, "did you mean 'e/q/seed");
  refused({"out/c", "nothing at all", "--output", "picked"}, "no job of it is called");
  refused({"out/c", "--output", "picked"}, "no picture is named");
  refused({"out/c", "e/q/seed1", "--list", "none.txt", "--output", "picked"}, "none.txt");
  refused({"elsewhere", "e/q/seed1", "--output", "picked"}, "there is no run.json");
  refused({"out/c", "e/q/seed1"}, "--output");
  refused({"out/c", "e/q/seed1", "--output", "out/c"}, "the run's own folder");
  refused({"out/c", "e/q/seed1", "--output", "."}, "has files that no pick made");
  refused({"out/c", "e/q/seed1", "--output", "e.png"}, "is no folder");
  JobRecord unfinished = *record("e/q/seed2");
  unfinished.status = Status::interrupted;
  write_record(folder_ / "out/c/e/q/seed2.json", unfinished);
  refused({"out/c", "e/q/seed2", "--output", "picked"}, "e/q/seed2 is not finished (interrupted)");
  write_image(folder_ / "e.png", Image(32, 32, 3, 0.5f), {});
  refused({"out/c", "e/q/seed1", "--output", "picked"},
          "its exemplar or a file of it has changed since it was made");
  fs::remove(folder_ / "e.png");
  refused({"out/c", "e/q/seed1", "--output", "picked"}, "e.png");
  EXPECT_FALSE(fs::exists(folder_ / "picked"));
}

}  // namespace
}  // namespace gramloom
