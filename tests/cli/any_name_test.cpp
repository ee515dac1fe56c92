// Names of files are just names, and files of any kind and content end in one line.
#include <sys/stat.h>

#include "cli/workspace.h"

namespace gramloom {
namespace {

class AnyName : public Workspace {
 protected:
  // A run of c.toml with its exemplar, in a folder of this name; and again, where all is finished.
  void expect_run(const std::string& folder) const {
    const auto in = [&](const std::string& name) { return (folder_ / folder / name).string(); };
    std::filesystem::create_directories(folder_ / folder);
    for (const std::string name : {"e.png", "c.toml"})
      std::filesystem::copy_file(folder_ / name, in(name));
    std::vector<std::string> arguments{"run", in("c.toml"), "--output", in("out")};
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << folder << outcome.errors;
    EXPECT_EQ(outcome.errors.find("not scored"), std::string::npos) << outcome.errors;
    arguments.push_back("--resume");
    const Outcome again = run(arguments);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_EQ(again.errors.find("again, "), std::string::npos) << again.errors;
  }
};

TEST_F(AnyName, OfFoldersMayHaveAnyLetters) {
  for (const std::string folder : {"why?", "a#b [c] {d}", "caf\xe9", "木目"}) expect_run(folder);
}

TEST_F(AnyName, ThatAreNoUtf8AreReplacedInWhatWeWrite) {
  std::filesystem::copy_file(folder_ / "e.png", folder_ / "caf\xe9.png");
  const Outcome scores = run({"score", "e.png", "caf\xe9.png", "--json"});
  EXPECT_EQ(scores.exit_code, 0) << scores.errors;
  EXPECT_NE(scores.output.find("caf\uFFFD.png"), std::string::npos) << scores.output;
  const std::vector<std::string> arguments{"run", "c.toml", "--set",
                                           "exemplar.e.image=caf\xe9.png"};
  EXPECT_EQ(run(arguments).exit_code, 0);
  std::vector<std::string> resumed = arguments;
  resumed.push_back("--resume");
  const Outcome again = run(resumed);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.errors.find("again, "), std::string::npos) << again.errors;
}

TEST_F(AnyName, OfPipesAndDevicesEndInALine) {
  mkfifo((folder_ / "pipe.png").c_str(), 0600);
  for (const auto& [arguments, code] : std::vector<std::pair<std::vector<std::string>, int>>{
           {{"score", "e.png", "pipe.png"}, 1},
           {{"score", "/dev/zero", "e.png"}, 1},
           {{"check", "pipe.png"}, 2},
           {{"check", "/dev/zero"}, 2},
           {{"run", "c.toml", "--set", "exemplar.e.image=pipe.png"}, 2},
           {{"run", "c.toml", "--set", "exemplar.e.maps={h='pipe.png'}"}, 2}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, code) << arguments[1] << outcome.errors;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  }
  std::filesystem::create_directories(folder_ / "base");
  mkfifo((folder_ / "base/run.json").c_str(), 0600);
  const Outcome outcome = run({"run", "c.toml", "--baseline", "base"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
}

TEST_F(AnyName, NestingEndsInALine) {
  std::string key = "a", lists(200'000, '[');
  for (int i = 0; i < 60'000; ++i) key += ".a";
  write_text(folder_ / "d.toml", key + "=1");
  const Outcome config = run({"check", "d.toml"});
  EXPECT_EQ(config.exit_code, 2);
  EXPECT_TRUE(is_one_line(config.errors)) << config.errors;
  EXPECT_EQ(run({"run", "c.toml"}).exit_code, 0);
  lists += std::string(200'000, ']');
  write_text(folder_ / "out/c/e/q/seed1.json", lists);
  EXPECT_EQ(run({"report", "out/c"}).exit_code, 0);
  write_text(folder_ / "out/c/run.json", lists);
  const Outcome report = run({"report", "out/c"});
  EXPECT_EQ(report.exit_code, 2);  // what the command is given is no run
  EXPECT_TRUE(is_one_line(report.errors)) << report.errors;
  const Outcome resumed = run({"run", "c.toml", "--resume"});
  EXPECT_EQ(resumed.exit_code, 2);  // it may be somebody's own file
  EXPECT_TRUE(is_one_line(resumed.errors)) << resumed.errors;
}

}  // namespace
}  // namespace gramloom
