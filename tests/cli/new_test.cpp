// `gramloom new`: a config to start from.
#include <gmock/gmock.h>

#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class NewCommand : public Workspace {
 protected:
  NewCommand() {
    fs::create_directories(folder_ / "photos");
    write_image(folder_ / "photos/wall.png", Image(64, 48, 3, 0.5f), {});
    write_image(folder_ / "photos/wall_height.png", Image(64, 48, 1, 0.5f), {});
    write_image(folder_ / "photos/floor.png", Image(64, 64, 3, 0.2f), {});
  }

  // Writes n.toml, which must pass `check`; what that says.
  std::string check_of(std::vector<std::string> from) const {
    fs::remove(folder_ / "n.toml");
    from.insert(from.begin(), "new");
    const Outcome made = run(from);
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    EXPECT_EQ(made.output, "n.toml\n");
    const Outcome checked = run({"check", "n.toml"});
    EXPECT_EQ(checked.exit_code, 0) << checked.errors << file("n.toml");
    EXPECT_THAT(checked.output, testing::Not(HasSubstr("cannot run")));
    return checked.output;
  }
};

TEST_F(NewCommand, WritesConfigsThatPassCheck) {
  EXPECT_THAT(check_of({"n.toml"}), HasSubstr("pebbles/neural/seed1"));
  const std::string folder = check_of({"n.toml", "--from", "photos"});
  EXPECT_THAT(folder, HasSubstr("wall/quilting/seed2"));
  EXPECT_THAT(folder, HasSubstr("floor/patchmatch/seed1"));
  EXPECT_THAT(folder, testing::Not(HasSubstr("wall_height")));
  const std::string several = check_of({"--from", "photos/wall.png", "photos/floor.png", "n.toml"});
  EXPECT_THAT(several, HasSubstr("12 jobs"));
}

TEST_F(NewCommand, EveryProposedKeyIsOneThatTheConfigTakes) {
  ASSERT_EQ(run({"new", "n.toml", "--from", "photos/wall.png"}).exit_code, 0);
  std::string text = file("n.toml");
  int proposals = 0;
  for (std::size_t at = 0; (at = text.find("\n# ", at)) != std::string::npos; ++at) {
    const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    if (line.find(" = ") == std::string::npos && line.find("  = ") == std::string::npos) continue;
    text.erase(at + 1, 2);
    ++proposals;
  }
  EXPECT_GT(proposals, 15);
  write_text(folder_ / "all.toml", text);
  const Outcome checked = run({"check", "all.toml"});
  EXPECT_EQ(checked.exit_code, 0) << checked.errors << text;
}

TEST_F(NewCommand, LargePhotographsAreScaledDownAndNamesAreUnique) {
  write_image(folder_ / "photos/large.png", Image(1500, 40, 3, 0.5f), {});
  fs::create_directories(folder_ / "more");
  fs::copy_file(folder_ / "e.png", folder_ / "more/e.png");
  check_of({"n.toml", "--from", "e.png", "more/e.png", "photos/large.png"});
  EXPECT_THAT(file("n.toml"), HasSubstr("\nmax_side"));
  EXPECT_THAT(file("n.toml"), HasSubstr("\"e_2\""));
}

TEST_F(NewCommand, MistakesAreOneLineAndExitCode2AndNothingIsReplaced) {
  fs::create_directories(folder_ / "empty");
  const std::string before = file("c.toml");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "config"},
      {{"c.toml"}, "c.toml is there already"},
      {{"c.toml", "--from", "e.png"}, "c.toml is there already"},
      {{"n.txt"}, ".toml"},
      {{"none/n.toml"}, "there is no folder"},
      {{"n.toml", "--from", "nothing.png"}, "--from nothing.png: there is no such picture"},
      {{"n.toml", "--from", "empty"}, "no picture"},
      {{"n.toml", "--from", "c.toml"}, "c.toml"},
  };
  for (const auto& [arguments, message] : cases) expect_refused("new", arguments, message);
  EXPECT_EQ(file("c.toml"), before);
  EXPECT_FALSE(fs::exists(folder_ / "n.toml"));
}

}  // namespace
}  // namespace gramloom
