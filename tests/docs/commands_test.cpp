// What the documents tell a reader to type works. Each ```sh block of a page is run in a copy of
// the project's folder, after the page's earlier blocks, and each ```toml block is checked as a
// config. Blocks of other languages are the subject of tests/examples and tests/python. Comments
// above a block say where it is otherwise, and why:
//
//   <!-- given: COMMAND -->      the test runs this before, to have what the reader has
//   <!-- in short: REASON -->    takes too long: tests/docs/in_short.sh says what is done instead
//   <!-- not run: REASON -->     needs what is not there
//   <!-- file: NAME -->          the block is saved as this file, for commands further down
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "cli/process.h"
#include "docs/markdown.h"
#include "io/temp_folder.h"
#include "io/text_file.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string note(const CodeBlock& block, const std::string& word) {
  for (const Note& one : block.notes)
    if (one.word == word) return one.text;
  return "";
}

void write_script(const fs::path& file, const std::string& text) {
  write_text(file, "#!/usr/bin/env bash\n" + text);
  fs::permissions(file, fs::perms::owner_all);
}

// A folder that looks like the project's, built, without what the tests don't need.
class PageOfCommands : public TempFolder, public testing::WithParamInterface<fs::path> {
 protected:
  void copy_project() const {
    fs::create_directories(path("build"));
    fs::create_directories(path("tests"));
    for (const char* folder : {"configs", "data", "models", "examples", "tests/golden"})
      fs::copy(source_folder() / folder, path(folder), fs::copy_options::recursive);
    write_script(path("gramloom"), "exec \"$GRAMLOOM\" \"$@\"\n");
    write_script(
        path("in_short"),
        fmt::format("exec '{}' \"$@\"\n", (source_folder() / "tests/docs/in_short.sh").string()));
  }

  // The commands, as bash has them typed: the first that fails ends them.
  Outcome type(const std::string& commands, bool in_short) const {
    for (const char* name : {"build/gramloom", "bootstrap"})
      fs::copy_file(path(in_short ? "in_short" : "gramloom"), path(name),
                    fs::copy_options::overwrite_existing);
    write_text(path("commands.sh"), "PATH=$PWD/build:$PATH\nset -x\n" + commands);
    return shell(path(), "exec bash -eo pipefail commands.sh");
  }

  void run(const CodeBlock& block) const {
    const Outcome outcome = type(block.text, !note(block, "in short").empty());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
  }

  // A config, or a part of one: what it lacks is added. Pictures are beside configs/, as there.
  void check(const CodeBlock& block) const {
    std::string text = block.text;
    const auto lacks = [&](const char* header) { return text.find(header) == std::string::npos; };
    if (lacks("[[exemplar]]") && lacks("kind = \"procedural\""))
      text +=
          "\n[[exemplar]]\nname = \"added\"\nimage = \"../data/pebbles.png\"\n"
          "maps = { height = \"../data/pebbles_height.png\" }\n";
    if (lacks("[[method]]") && lacks("[[model]]"))
      text += "\n[[method]]\nname = \"added\"\nkind = \"quilting\"\n";
    write_text(path("configs/block.toml"), text);
    const Outcome outcome = shell(path(), "exec \"$GRAMLOOM\" check configs/block.toml");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, testing::Not(HasSubstr("cannot run"))) << text;
  }

  void test(const CodeBlock& block) const {
    for (const Note& one : block.notes)
      EXPECT_THAT(one.word, testing::AnyOf("given", "in short", "not run", "file"));
    EXPECT_THAT(block.language, testing::AnyOf("", "sh", "toml", "cpp", "cmake", "python"));
    if (!note(block, "not run").empty()) return;
    for (const Note& one : block.notes)
      if (one.word == "given") {
        const Outcome given = type(one.text, false);
        EXPECT_EQ(given.exit_code, 0) << one.text << "\n" << given.errors;
      }
    if (const std::string file = note(block, "file"); !file.empty())
      write_text(path(file), block.text);
    else if (block.language == "sh")
      run(block);
    else if (block.language == "toml")
      check(block);
  }
};

TEST_P(PageOfCommands, Works) {
  const Page page = read_page(GetParam());
  if (!page.blocks.empty()) copy_project();
  for (const CodeBlock& block : page.blocks) {
    SCOPED_TRACE(fmt::format("{}:{}", GetParam().string(), block.line));
    test(block);
  }
}

INSTANTIATE_TEST_SUITE_P(, PageOfCommands, testing::ValuesIn(markdown_files()),
                         [](const testing::TestParamInfo<fs::path>& file) {
                           const fs::path page = fs::relative(file.param, source_folder());
                           std::string name = page.parent_path().string() + page.stem().string();
                           std::erase_if(name, [](char letter) { return !std::isalnum(letter); });
                           return name;
                         });

}  // namespace
}  // namespace gramloom
