// The executable's arguments, exit codes and messages.
#include <sys/stat.h>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class CommandLine : public Workspace {};

TEST_F(CommandLine, HelpAndVersion) {
  for (const std::string command : {"", "run", "check", "list", "report", "benchmark"}) {
    const Outcome help = command.empty() ? run({"--help"}) : run({command, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Usage: gramloom " + command), std::string::npos) << help.output;
    EXPECT_EQ(help.errors, "");
  }
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.output, testing::MatchesRegex("gramloom [0-9.]+ \\(build [0-9a-f]{12}\\)\n"));
}

TEST_F(CommandLine, BadUsageIsOneLineAndExitCode2) {
  const std::vector<std::vector<std::string>> mistakes{
      {},
      {"frobnicate"},
      {"run"},
      {"run", "c.toml", "--frobnicate"},
      {"run", "c.toml", "--threads", "-1"},
      {"run", "c.toml", "--threads", "many"},
      {"run", "c.toml", "--threads", "100000"},
      {"run", "c.toml", "--threads", "99999999999"},
      {"run", "c.toml", "--only"},
      {"run", "c.toml", "--only", "nothing/*"},
      {"run", "c.toml", "d.toml"},
      {"run", "c.toml", "--set", "nonsense"},
      {"run", "c.toml", "--set", "size=0"},
      {"run", "no.toml"},
      {"run", "."},
      {"run", ""},
      {"check", "no.toml"},
      {"list", "frobs"},
  };
  for (const auto& arguments : mistakes) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CommandLine, AFileThatCannotEvenBeLookedAtIsNamed) {
  const std::string file(300, 'a');  // longer than the system's names
  const std::vector<std::vector<std::string>> cases{{"make", file + ".png", "--output", "o.png"},
                                                    {"new", "a.toml", "--from", file + ".png"},
                                                    {"run", file + ".toml"}};
  for (const auto& arguments : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[0];
    EXPECT_THAT(outcome.errors, testing::HasSubstr(": File name too long")) << arguments[0];
    EXPECT_THAT(outcome.errors, testing::Not(testing::HasSubstr("filesystem error")));
  }
}

TEST_F(CommandLine, AnUnknownWordIsNamedWithTheOneThatMayBeMeant) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "needed is a command"},
      {{"frobnicate"}, "there is no command 'frobnicate'"},
      {{"frobnicate", "--size", "3"}, "there is no command 'frobnicate'"},
      {{"lsit"}, "there is no command 'lsit'; did you mean 'list'?"},
      {{"lsit", "run", "c.toml"}, "there is no command 'lsit'; did you mean 'list'?"},
      {{"--verison"}, "there is no option '--verison'; did you mean '--version'?"},
      {{"run", "--quite"}, "run: there is no option '--quite'; did you mean '--quiet'?"},
      {{"run", "c.toml", "--thread=2"},
       "run: there is no option '--thread'; did you mean '--threads'?"},
      {{"run", "c.toml", "d.toml"}, "run: 'd.toml' is one word too many"},
      {{"score", "e.png"}, "score: needed is 'images': pictures to score"},
      {{"score", "e.png", "e.png", "--tile", "z"},
       "--tile: there is no 'z'; allowed are none, x, y, both"},
      {{"make", "e.png", "--tile", "boht"},
       "--tile: there is no 'boht'; allowed are none, x, y, both; did you mean 'both'?"},
      {{"completion", "bsh"},
       "shell: there is no 'bsh'; allowed are bash, zsh, fish, words; did you mean 'bash'?"}};
  for (const auto& [words, says] : cases) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors, says + " (see --help)\n");
  }
}

TEST_F(CommandLine, AFolderThatIsNoRunIsNamedOnceByEveryCommand) {
  const std::vector<std::vector<std::string>> commands{
      {"report", "nosuch"},
      {"benchmark", "nosuch"},
      {"pick", "nosuch", "e/q/seed1", "--output", "x"},
      {"export", "nosuch", "--target", "gltf", "--output", "x"}};
  for (const auto& words : commands) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << words.front();
    EXPECT_EQ(outcome.errors, "nosuch: there is no run.json, so this is not the folder of a run\n");
  }
}

TEST_F(CommandLine, AMistakeInTheConfigIsShownWithItsPlace) {
  write_text(folder_ / "bad.toml", file("c.toml") + "octave = 3\n");
  for (const std::string command : {"run", "check"}) {
    const Outcome outcome = run({command, "bad.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors, "bad.toml:14:1: unknown key 'octave' (did you mean 'octaves'?)\n");
  }
}

TEST_F(CommandLine, RunDoesEveryJob) {
  const Outcome outcome = run({"run", "c.toml"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 5) << outcome.errors;
  EXPECT_EQ(outcome.errors.find('\r'), std::string::npos) << "a bar where no terminal is";
  for (const std::string job : {"e/q/seed1", "e/q/seed2", "procedural/n/seed1"}) {
    ASSERT_TRUE(record(job)) << job;
    EXPECT_EQ(record(job)->status, Status::done);
    EXPECT_EQ(read_image(folder_ / "out/c" / (job + ".png")).image.size(), (Size{40, 24}));
  }
}

TEST_F(CommandLine, QuietSaysNothing) {
  const Outcome outcome = run({"run", "c.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors + outcome.output, "");
}

TEST_F(CommandLine, OutputOnlySetAndThreads) {
  const Outcome outcome = run({"run", "c.toml", "--output", "there", "--only", "e/*/seed2", "--set",
                               "size=16", "--set", "patch_size=5", "--threads", "1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(read_image(folder_ / "there/e/q/seed2.png").image.size(), (Size{16, 16}));
  EXPECT_FALSE(fs::exists(folder_ / "there/e/q/seed1.png"));
  EXPECT_FALSE(fs::exists(folder_ / "there/procedural"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(record("e/q/seed2", "there")->settings["method"]["patch_size"], 5);
}

TEST_F(CommandLine, ThreadsDoNotChangeTheBytes) {
  run({"run", "c.toml", "--output", "one", "--threads", "1"});
  run({"run", "c.toml", "--output", "three", "--threads", "3"});
  for (const std::string job : {"e/q/seed1", "procedural/n/seed1"})
    EXPECT_EQ(file("one/" + job + ".png"), file("three/" + job + ".png")) << job;
}

TEST_F(CommandLine, PathsOfAConfigAreRelativeToIt) {
  fs::create_directories(folder_ / "elsewhere");
  const Outcome outcome =
      shell(folder_ / "elsewhere", "$GRAMLOOM run ../c.toml --quiet --output ../there");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  run({"run", "c.toml"});
  EXPECT_EQ(file("there/e/q/seed1.png"), file("out/c/e/q/seed1.png"))
      << "where a run is called from changes nothing, the metadata included";
}

TEST_F(CommandLine, CheckListsTheJobsAndRunsNothing) {
  const Outcome outcome = run({"check", "c.toml"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string job : {"e/q/seed1", "procedural/n/seed2", "4 jobs"})
    EXPECT_NE(outcome.output.find(job), std::string::npos) << outcome.output;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CommandLine, AJobThatCannotFitIsRefusedAndTheOthersAreDone) {
  write_text(folder_ / "big.toml",
             "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n");
  const Outcome check = run({"check", "big.toml", "--set", "size=65536"});
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(check.output.find("would fit"), std::string::npos) << check.output;
  const Outcome outcome = run({"run", "big.toml", "--set", "size=65536", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(record("procedural/n/seed1", "out/big")->error.find("would fit"), std::string::npos);
}

TEST_F(CommandLine, AFailedJobAmongGoodOnes) {
  write_text(folder_ / "broken.png", file("e.png").substr(0, 100));
  write_text(folder_ / "c.toml",
             file("c.toml") + "[[exemplar]]\nname = 'b'\nimage = 'broken.png'\n");
  const Outcome outcome = run({"run", "c.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 2) << outcome.errors;
  EXPECT_EQ(record("b/q/seed1")->status, Status::failed);
  EXPECT_EQ(record("e/q/seed2")->status, Status::done);
}

TEST_F(CommandLine, AnOutputThatCannotBeWritten) {
  write_text(folder_ / "plain", "a file");
  for (const std::string output : {"plain", "plain/below", "/proc/nothing", "/dev/null/x"}) {
    const Outcome outcome = run({"run", "c.toml", "--output", output});
    EXPECT_EQ(outcome.exit_code, 2) << output;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  }
}

TEST_F(CommandLine, AFileSizeLimitIsAFailedJobAndNoCrash) {
  // 512 or 1024 bytes a block, by shell: enough for the records and the page, not for the picture.
  const Outcome outcome = shell(
      folder_, "ulimit -f 400; $GRAMLOOM run c.toml --only 'e/q/seed1' --set size=1000 --quiet");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(outcome.errors.find("cannot write: File too large"), std::string::npos);
}

TEST_F(CommandLine, APageThatCannotBeWrittenLosesNoResult) {
  const Outcome outcome =
      shell(folder_, "ulimit -f 32; $GRAMLOOM run c.toml --only 'e/q/seed1' --quiet");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(outcome.errors.find("no page: "), std::string::npos) << outcome.errors;
  EXPECT_EQ(record("e/q/seed1")->status, Status::done);
}

TEST_F(CommandLine, ReportWritesThePageOfARunAgain) {
  run({"run", "c.toml", "--quiet"});
  const std::string page = file("out/c/index.html");
  EXPECT_NE(page.find("e/q/seed2"), std::string::npos);
  EXPECT_NO_THROW(read_image(folder_ / "out/c/e/exemplar.png"));
  fs::rename(folder_ / "out/c", folder_ / "elsewhere");
  fs::remove(folder_ / "elsewhere/index.html");
  const Outcome outcome = run({"report", "elsewhere"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output, "elsewhere/index.html\n");
  EXPECT_TRUE(file("elsewhere/index.html") == page) << "all of it is in the folder";
  for (const std::string folder : {".", "nowhere", "e.png"}) {
    const Outcome none = run({"report", folder});
    EXPECT_EQ(none.exit_code, 2) << folder;
    EXPECT_TRUE(is_one_line(none.errors)) << none.errors;
  }
}

TEST_F(CommandLine, APageThatLacksAPictureIsNoFullSuccess) {
  run({"run", "c.toml", "--quiet"});
  fs::remove(folder_ / "out/c/e/q/seed2.png");
  const Outcome outcome = run({"report", "out/c"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(outcome.errors.find("not on the page: "), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.output, "out/c/index.html\n") << "all else is";
}

TEST_F(CommandLine, ListNamesMethodsPatternsAndTheirParameters) {
  const Outcome all = run({"list"});
  EXPECT_EQ(all.exit_code, 0);
  for (const std::string word : {"quilting", "patch_size", "procedural", "noise", "octaves"})
    EXPECT_NE(all.output.find(word), std::string::npos) << word;
  EXPECT_EQ(run({"list", "methods"}).output.find("lacunarity"), std::string::npos);
  EXPECT_NE(run({"list", "patterns"}).output.find("lacunarity"), std::string::npos);
  EXPECT_EQ(run({"list", "networks"}).exit_code, 0);
}

TEST_F(CommandLine, AReaderThatGoesAwayOrStreamsThatAreClosedDoNoHarm) {
  EXPECT_EQ(shell(folder_, "$GRAMLOOM run c.toml 2>&1 >/dev/null | true; test -e out/c/run.json")
                .exit_code,
            0);
  EXPECT_EQ(shell(folder_, "$GRAMLOOM run c.toml --output a <&- >&- 2>&-").exit_code, 0);
  EXPECT_EQ(record("e/q/seed2", "a")->status, Status::done);
  EXPECT_EQ(read_image(folder_ / "a/e/q/seed2.png").image.size(), (Size{40, 24}));
  EXPECT_EQ(shell(folder_, "($GRAMLOOM list; echo $? >code) | true; cat code").output, "0\n");
  EXPECT_EQ(shell(folder_, "$GRAMLOOM list > /dev/full").exit_code, 1);
}

}  // namespace
}  // namespace gramloom
