// Names and paths of every kind, from outside.
#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Names : public Workspace {
 protected:
  // Two pictures called "photo": one beside the config in sub/, a grey one in the current folder.
  void write_photos() const {
    fs::create_directories(folder_ / "sub");
    fs::copy_file(folder_ / "e.png", folder_ / "sub/photo");
    write_image(folder_ / "grey.png", Image(32, 32, 1, 0.5f), {});
    fs::rename(folder_ / "grey.png", folder_ / "photo");
    write_text(folder_ / "sub/c.toml",
               "size = 24\n[[exemplar]]\nname = 'e'\nimage = 'photo'\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n");
  }
};

TEST_F(Names, ABareNameIsTheFileBesideTheConfig) {
  write_photos();
  const Outcome outcome = run({"run", "sub/c.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(read_image(folder_ / "out/c/e/exemplar.png").image,
            read_image(folder_ / "e.png").image);
  fs::remove(folder_ / "sub/photo");
  for (const std::string command : {"run", "check"}) {
    const Outcome none = run({command, "sub/c.toml"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_EQ(none.errors, "sub/c.toml:4:1: there is no file sub/photo\n");
  }
}

TEST_F(Names, APathOfSetIsThatOfTheCurrentFolderAlsoInTheRecord) {
  write_photos();
  ASSERT_EQ(run({"run", "sub/c.toml", "--quiet", "--set", "exemplar.e.image=e.png"}).exit_code, 0);
  EXPECT_EQ(Json::parse(file("out/c/run.json"))["settings"]["exemplar"][0]["image"], "../e.png");
}

TEST_F(Names, BracketsSignsAndLettersOfManyBytes) {
  std::string stones;
  for (int i = 0; i < 85; ++i) stones += "石";  // 255 bytes
  const std::string odd = "100% [a] #1 {b} ~ (c)";
  write_text(folder_ / "c.toml", "size = 24\n[[exemplar]]\nname = '" + stones +
                                     "'\nimage = 'e.png'\nmaps = { '" + stones.substr(0, 234) +
                                     "' = 'e.png' }\n" + "[[method]]\nname = '" + odd +
                                     "'\nkind = 'quilting'\npatch_size = 8\n");
  const std::string folder = "out/c/" + stones + "/" + odd;
  const Outcome outcome = run({"run", "c.toml", "--quiet", "--only", "*/100% [a] #?*"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(fs::exists(folder_ / folder / ("seed1_" + stones.substr(0, 234) + ".png")));
  EXPECT_EQ(run({"run", "c.toml", "--only", "*/100% [ab] #?*"}).exit_code, 2);
  EXPECT_EQ(run({"run", "c.toml", "--quiet", "--resume"}).exit_code, 0);
}

TEST_F(Names, BytesThatAreNoUtf8) {
  const std::string picture = "caf\xe9.png";
  fs::copy_file(folder_ / "e.png", folder_ / picture);
  const std::vector<std::string> arguments{"run",   "c.toml", "--output",
                                           "o\xff", "--set",  "exemplar.e.image=" + picture};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(record("e/q/seed1", "o\xff")->status, Status::done);
  auto again = arguments;
  again.push_back("--resume");
  EXPECT_NE(run(again).errors.find("e/q/seed1: finished before"), std::string::npos);
}

TEST_F(Names, OneOfOurOwnFilesIsAMistakeOfTheConfig) {
  write_text(folder_ / "c.toml",
             "[[exemplar]]\nname = 'scores.csv'\nimage = 'e.png'\n"
             "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n");
  for (const std::string command : {"run", "check"}) {
    const Outcome outcome = run({command, "c.toml"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.errors,
              "c.toml:2:1: the name 'scores.csv' is taken by a file of the run's own: choose "
              "another\n");
  }
}

}  // namespace
}  // namespace gramloom
