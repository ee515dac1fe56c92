// What the program has, the documents and ./bootstrap name.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "cli/help_text.h"
#include "cli/process.h"
#include "io/json_text.h"
#include "io/temp_folder.h"
#include "io/text_file.h"
#include "source_folder.h"

namespace gramloom {
namespace {

using testing::HasSubstr;

class Names : public TempFolder {
 protected:
  std::string output_of(const std::string& words) const {
    return shell(path(), "\"$GRAMLOOM\" " + words).output;
  }

  // As --help has them.
  std::vector<std::string> commands() const { return commands_in(output_of("--help")); }

  std::vector<std::string> listed(const std::string& topic) const {
    std::vector<std::string> names;
    for (const Json& one : parse_json(output_of("list " + topic + " --json")))
      names.push_back(one["name"]);
    return names;
  }
};

std::string document(const char* name) { return read_text(source_folder() / "docs" / name); }

TEST_F(Names, TheDocumentsHaveEveryCommandMethodAndTexture) {
  ASSERT_GT(commands().size(), 15u);
  for (const std::string& name : commands())
    EXPECT_THAT(document("command-line.md"), HasSubstr(fmt::format("\n| `gramloom {} ", name)));
  ASSERT_GT(listed("methods").size(), 10u);
  for (const std::string& name : listed("methods"))
    EXPECT_THAT(document("methods.md"), HasSubstr(fmt::format("\n| `{}` |", name)));
  ASSERT_GT(listed("patterns").size(), 20u);
  for (const std::string& name : listed("patterns"))
    EXPECT_THAT(document("procedural.md"),
                testing::ContainsRegex(fmt::format("[ ,]{}[ ,.]", name)));
}

// ./bootstrap passes on each command of the program, and no other word.
TEST_F(Names, BootstrapHasEveryCommand) {
  const std::string bootstrap = fmt::format("'{}'", (source_folder() / "bootstrap").string());
  const Outcome usage = shell(path(), bootstrap);
  EXPECT_EQ(usage.exit_code, 2);
  const std::string words = usage.errors.substr(usage.errors.find("Commands:"));
  for (const std::string& name : commands())
    EXPECT_THAT(words, HasSubstr(fmt::format(" {} ", name)));
  const Outcome mistake = shell(path(), bootstrap + " frob");
  EXPECT_EQ(mistake.exit_code, 2);
  EXPECT_THAT(mistake.errors, HasSubstr("no command 'frob'"));
}

}  // namespace
}  // namespace gramloom
