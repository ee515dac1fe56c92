// No run touches a file that it reads, or one that no run made.
#include <map>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Inputs : public Workspace {
 protected:
  // Exit code 2 and this one line, with every file as it was.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& line) const {
    const auto before = files();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_EQ(outcome.errors, line + "\n");
    EXPECT_TRUE(files() == before) << line;
  }
  std::map<fs::path, std::string> files() const {
    std::map<fs::path, std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (entry.is_regular_file()) texts[entry.path()] = read_text(entry.path());
    return texts;
  }
  int run_quietly(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "run");
    arguments.push_back("--quiet");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.errors, "");
    return outcome.exit_code;
  }
};

TEST_F(Inputs, AFolderThatIsNotThereIsToldBeforeTheWork) {
  const std::vector<std::vector<std::string>> commands{
      {"export", "pebbles", "--target", "c", "--output", "none/a.c"},
      {"make", "e.png", "--kind", "histogram", "--size", "16", "--output", "none/a.png"},
      {"preview", "e.png", "--output", "none/a.png"}};
  for (const auto& words : commands) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << words.front();
    EXPECT_THAT(outcome.errors, testing::HasSubstr("there is no folder")) << words.front();
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }
}

TEST_F(Inputs, AnExemplarInTheOutputFolder) {
  fs::create_directories(folder_ / "brick");
  fs::create_directories(folder_ / "pebbles");
  fs::copy_file(folder_ / "e.png", folder_ / "pebbles/exemplar.png");
  write_image(folder_ / "brick/exemplar.tif", read_image(folder_ / "e.png").image, {});
  const std::string method = "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n";
  write_text(folder_ / "brick.toml",
             "[[exemplar]]\nname = 'brick'\nimage = 'brick/exemplar.tif'\n" + method);
  write_text(
      folder_ / "pebbles.toml",
      "[[exemplar]]\nname = 'pebbles'\nimage = 'pebbles/exemplar.png'\nmax_side = 16\n" + method);
  // A folder that is asked to be the output is not made ours by a lock.
  expect_refused({"run", "brick.toml", "--output", "."},
                 "--output .: would write over brick/exemplar.tif, which the config reads");
  expect_refused({"run", "pebbles.toml", "--output", "."},
                 "--output .: would write over pebbles/exemplar.png, which the config reads");
}

TEST_F(Inputs, AnExemplarByAnotherName) {
  for (const bool hard : {true, false}) {
    fs::remove_all(folder_ / "out");
    fs::create_directories(folder_ / "out/c/e/q");
    const fs::path link = folder_ / "out/c/e/q/seed1.png";
    hard ? fs::create_hard_link(folder_ / "e.png", link)
         : fs::create_symlink(folder_ / "e.png", link);
    expect_refused({"run", "c.toml"},
                   "--output out/c: would write over out/c/e/q/seed1.png, the same file as e.png, "
                   "which the config reads");
  }
}

TEST_F(Inputs, AResultThatIsTheStartOfAnother) {
  ASSERT_EQ(run_quietly({"c.toml"}), 0);
  write_text(folder_ / "n.toml",
             "size = 24\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "[[method]]\nname = 'q'\nkind = 'neural'\nstart = 'out/c/e/q/seed1.png'\n");
  expect_refused({"run", "n.toml", "--output", "out/c"},
                 "--output out/c: would write over out/c/e/q/seed1.png, which the config reads");
}

TEST_F(Inputs, ABaselineBelowTheOutputFolder) {
  ASSERT_EQ(run_quietly({"c.toml", "--output", "now/e"}), 0);
  fs::copy(folder_ / "now/e", folder_ / "before", fs::copy_options::recursive);
  fs::create_directories(folder_ / "now/e/q");
  fs::create_hard_link(folder_ / "before/e/q/seed1.png", folder_ / "now/e/q/seed1.png");
  expect_refused({"run", "c.toml", "--output", "now", "--baseline", "before"},
                 "--output now: would write over now/e/q/seed1.png, the same file as "
                 "before/e/q/seed1.png, which --baseline reads");
}

TEST_F(Inputs, AFileThatNoRunMade) {
  for (const std::string name :
       {"run.json", "scores.csv", "index.html", "baseline.json", "e/exemplar.png", "e/exemplar.tif",
        "e/q/seed1.png", "e/q/seed2.json", "e/q/seed1.csv", "e/q/seed1.copy_map.png",
        "e/q/seed1.checkpoint", "procedural/n/seed1_height.png"}) {
    fs::remove_all(folder_ / "out");
    const fs::path file = folder_ / "out/c" / name;
    fs::create_directories(file.parent_path());
    write_text(file, "mine");
    expect_refused({"run", "c.toml"}, "--output out/c: would replace out/c/" + name +
                                          ", which no run of gramloom made");
    const Outcome check = run({"check", "c.toml"});
    EXPECT_NE(check.output.find("cannot run: --output out/c: would replace out/c/" + name),
              std::string::npos)
        << check.output;
  }
}

TEST_F(Inputs, AFileThatNoRunMadeAmongThoseOfARun) {
  for (const std::string name : {"scores.csv", "index.html", "procedural/n/seed2_mask.png"}) {
    fs::remove_all(folder_ / "out");
    ASSERT_EQ(run_quietly({"c.toml"}), 0);
    fs::remove(folder_ / "out/c" / name);
    write_text(folder_ / "out/c" / name, "mine");
    expect_refused({"run", "c.toml", "--resume"}, "--output out/c: would replace out/c/" + name +
                                                      ", which no run of gramloom made");
  }
  fs::remove_all(folder_ / "out");
  fs::create_directories(folder_ / "out/c");
  fs::create_symlink("nowhere", folder_ / "out/c/index.html");
  expect_refused({"run", "c.toml"},
                 "--output out/c: would replace out/c/index.html, which no run of gramloom made");
}

TEST_F(Inputs, WhatIsNoneOfOurNamesMayLieAmongThem) {
  ASSERT_EQ(run_quietly({"c.toml"}), 0);
  for (const std::string name : {"notes.txt", "e/photo.png", "e/q/seed1_edited.png",
                                 "e/q/seed10.png", "e/q/seed1.txt", "e/q/seed1.xcf"})
    write_text(folder_ / "out/c" / name, "mine");
  ASSERT_EQ(run_quietly({"c.toml"}), 0);
  for (const std::string name : {"notes.txt", "e/photo.png", "e/q/seed1_edited.png",
                                 "e/q/seed10.png", "e/q/seed1.txt", "e/q/seed1.xcf"})
    EXPECT_EQ(file("out/c/" + name), "mine");
}

TEST_F(Inputs, ResultsOfOursAreReplacedWhateverBecameOfTheRun) {
  ASSERT_EQ(run_quietly({"c.toml"}), 0);
  EXPECT_EQ(run_quietly({"c.toml"}), 0);
  EXPECT_EQ(run_quietly({"c.toml", "--resume", "--set", "pixel_type=float"}), 0);
  EXPECT_EQ(run_quietly({"c.toml", "--only", "e/q/seed1", "--set", "format=tif"}), 0);
  EXPECT_EQ(run_quietly({"c.toml", "--set", "seeds=[3]"}), 0) << "run.json forgets seeds 1 and 2";
  EXPECT_EQ(run_quietly({"c.toml"}), 0);
  write_text(folder_ / "out/c/e/q/seed1.json", "{\"status\": \"done\"");
  EXPECT_EQ(run_quietly({"c.toml"}), 0) << "a record that is not whole";
  write_text(folder_ / "c.toml", file("c.toml") + "octaves = 3\n");
  EXPECT_EQ(run_quietly({"c.toml", "--resume"}), 0) << "edited";
}

TEST_F(Inputs, TwoConfigsOfOneName) {
  for (const std::string folder : {"a", "b"}) {
    fs::create_directories(folder_ / folder);
    fs::copy_file(folder_ / "e.png", folder_ / folder / "e.png");
    fs::copy_file(folder_ / "c.toml", folder_ / folder / "x.toml");
  }
  ASSERT_EQ(run_quietly({"a/x.toml"}), 0);
  expect_refused({"run", "b/x.toml"},
                 "--output out/x: holds the results of a/x.toml; choose another folder for those "
                 "of b/x.toml");
  EXPECT_NE(run({"check", "b/x.toml"}).output.find("holds the results of a/x.toml"),
            std::string::npos);
  EXPECT_EQ(run_quietly({(folder_ / "a/x.toml").string()}), 0) << "the same by its whole path";
  EXPECT_EQ(run_quietly({"b/x.toml", "--output", "out/x"}), 0) << "as the user says";
  EXPECT_EQ(run_quietly({"b/x.toml"}), 0);
  fs::rename(folder_ / "b", folder_ / "c");
  EXPECT_EQ(run_quietly({"c/x.toml"}), 0) << "moved";
}

TEST_F(Inputs, ReportReplacesAPageAlone) {
  ASSERT_EQ(run_quietly({"c.toml"}), 0);
  EXPECT_EQ(run({"report", "out/c"}).exit_code, 0);
  write_text(folder_ / "out/c/index.html", "<html>mine</html>");
  expect_refused({"report", "out/c"},
                 "report out/c: would replace out/c/index.html, which no run of gramloom made");
}

}  // namespace
}  // namespace gramloom
