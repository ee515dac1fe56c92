// The manual, completions and lists as JSON: what the program says of itself, in full.
#include <gmock/gmock.h>

#include <set>

#include "cli/help_text.h"
#include "cli/workspace.h"
#include "io/json_text.h"
#include "jobs/key_lists.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsSubsetOf;

class Manual : public Workspace {
 protected:
  std::string output_of(const std::vector<std::string>& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << fmt::format("{}: {}", fmt::join(words, " "), outcome.errors);
    return outcome.output;
  }

  // What completes the last word.
  std::vector<std::string> completed(std::vector<std::string> words) const {
    words.insert(words.begin(), {"completion", "words", "--"});
    std::vector<std::string> candidates;
    std::istringstream lines(output_of(words));
    for (std::string line; std::getline(lines, line);)
      candidates.push_back(line.substr(0, line.find('\t')));
    return candidates;
  }

  // The commands and their options as --help has them.
  std::vector<std::string> commands() const { return commands_in(output_of({"--help"})); }
  std::set<std::string> options(const std::string& command) const {
    std::set<std::string> names;
    std::istringstream lines(output_of({command, "--help"}));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("  -"))
        if (const auto at = line.find("--"); at != std::string::npos)
          names.insert(line.substr(at, line.find_first_of(" ,{", at) - at));
    return names;
  }
};

// As roff writes a word.
std::string roff(std::string word) {
  for (std::size_t at = 0; (at = word.find('-', at)) != std::string::npos; at += 2)
    word.insert(at, "\\");
  return word;
}

// Every list, by the heading that it has in the manual.
std::vector<std::pair<std::string, KeyList>> all_lists() {
  std::vector<std::pair<std::string, KeyList>> all;
  const auto add = [&](const std::string& kind, const std::vector<KeyList>& lists) {
    for (const KeyList& list : lists)
      all.emplace_back(list.name.empty() ? "TOP LEVEL" : kind + list.name, list);
  };
  add("METHOD ", method_lists());
  add("TEXTURE ", texture_lists());
  add("MODEL ", model_lists());
  add("", table_lists());
  return all;
}

TEST_F(Manual, NamesEveryCommandAndEveryOption) {
  ASSERT_GT(commands().size(), 15u);
  const std::string program = output_of({"manual"});
  for (const std::string& command : commands()) {
    EXPECT_THAT(program, HasSubstr(roff("gramloom-" + command) + "(1)"));
    const std::string page = output_of({"manual", "gramloom-" + command});
    for (const std::string& option : options(command))
      EXPECT_THAT(page, HasSubstr(roff(option))) << command;
  }
  EXPECT_EQ(run({"manual", "gramloom-frob"}).exit_code, 2);
}

// Those of --help, which are those of the manual.
TEST_F(Manual, ExamplesUseOptionsThatThereAre) {
  for (const std::string& command : commands()) {
    const std::string page = output_of({"manual", "gramloom-" + command});
    const std::set<std::string> known = options(command);
    const std::string help = output_of({command, "--help"});
    std::istringstream lines(help.substr(std::min(help.find("\nExamples:\n"), help.size())));
    int examples = 0;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t begin = line.find("gramloom ");
      if (begin == std::string::npos) continue;
      ++examples;
      EXPECT_THAT(line.substr(begin), testing::StartsWith("gramloom " + command + " "));
      EXPECT_THAT(page, HasSubstr(roff(line.substr(2))));
      std::istringstream words(line);
      for (std::string word; words >> word;)
        EXPECT_TRUE(!word.starts_with("--") || known.contains(word)) << line;
    }
    EXPECT_GT(examples, 0) << command;
  }
}

TEST_F(Manual, ExplainsEveryKeyOfTheConfig) {
  const std::string page = output_of({"manual", "gramloom-config"});
  for (const auto& [heading, list] : all_lists()) {
    const std::size_t begin = page.find(fmt::format(".SH \"{}\"\n", roff(heading)));
    ASSERT_NE(begin, std::string::npos) << heading;
    const std::string section = page.substr(begin, page.find("\n.SH", begin) - begin);
    for (const Key& key : list.keys) {
      EXPECT_THAT(section, HasSubstr(fmt::format("\\fB{}\\fR", roff(key.name)))) << heading;
      EXPECT_THAT(section, HasSubstr(roff(key.description))) << heading;
    }
  }
}

TEST_F(Manual, RoffFindsNoFault) {
  if (shell(folder_, "man --version").exit_code != 0) GTEST_SKIP() << "no man on this machine";
  output_of({"manual", "--output", "man"});
  EXPECT_TRUE(fs::exists(folder_ / "man/man1/gramloom-make.1"));
  EXPECT_TRUE(fs::exists(folder_ / "man/man5/gramloom-config.5"));
  const Outcome outcome =
      shell(folder_,
            "export LC_ALL=C.UTF-8 MANWIDTH=80 MANROFFSEQ=''; for page in man/man*/*; do "
            "man --warnings -E UTF-8 -l -Tutf8 -Z $page >>all.txt || exit 1; done");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(Manual, CompletionsKnowCommandsOptionsAndWords) {
  EXPECT_THAT(completed({""}), testing::UnorderedElementsAreArray(commands()));
  EXPECT_THAT(completed({"ru"}), testing::ElementsAre("run"));
  for (const std::string& command : commands()) {
    const std::set<std::string> known = options(command);
    EXPECT_THAT(known, IsSubsetOf(completed({command, "-"}))) << command;
  }
  EXPECT_THAT(completed({"list", "me"}), testing::ElementsAre("methods", "metrics"));
  EXPECT_THAT(completed({"make", "e.png", "--kind", "p"}), testing::Contains("patchmatch"));
  EXPECT_THAT(completed({"make", "e.png", "--preset", ""}), testing::Contains("balanced"));
  EXPECT_THAT(completed({"make", "bri"}), testing::ElementsAre("brick"));
  EXPECT_THAT(completed({"run", ""}), testing::ElementsAre("c.toml"));
  EXPECT_THAT(completed({"make", "e.png", "--output", ""}), testing::IsEmpty());
  EXPECT_THAT(completed({"frob", ""}), testing::IsEmpty());
}

TEST_F(Manual, CompletionsKnowEveryKeyAfterSet) {
  const std::vector<std::string> keys = completed({"run", "c.toml", "--set", ""});
  for (const auto& lists : {method_lists(), texture_lists()})
    for (const KeyList& list : lists)
      for (const Key& key : list.keys) EXPECT_THAT(keys, testing::Contains(key.name + "="));
  for (const KeyList& table : table_lists()) {
    if (table.name.starts_with("[[")) continue;
    const std::string prefix =
        table.name.empty() ? "" : table.name.substr(1, table.name.size() - 2) + ".";
    for (const Key& key : table.keys) EXPECT_THAT(keys, testing::Contains(prefix + key.name + "="));
  }
  EXPECT_THAT(completed({"run", "c.toml", "--set", "preset=ba"}),
              testing::ElementsAre("preset=balanced"));
  EXPECT_THAT(completed({"run", "c.toml", "--set", "network=vgg1"}),
              testing::ElementsAre("network=vgg19"));
  EXPECT_THAT(completed({"make", "e.png", "--set", "seeds"}), testing::IsEmpty());
}

TEST_F(Manual, CompletionsFollowFromWhatStandsBefore) {
  const std::vector<KeyList> methods = method_lists();
  const auto quilting = std::ranges::find(methods, "quilting", &KeyList::name);
  std::vector<std::string> keys;
  for (const Key& key : quilting->keys) keys.push_back(key.name + "=");
  EXPECT_THAT(completed({"make", "e.png", "--kind", "quilting", "--set", ""}),
              testing::ElementsAreArray(keys));
  EXPECT_THAT(completed({"make", "--kind=quilting", "e.png", "--set", ""}),
              testing::ElementsAreArray(keys));
  EXPECT_THAT(completed({"make", "e.png", "--kind", "quilting", "--preset", ""}),
              testing::IsEmpty());
  EXPECT_THAT(completed({"make", "e.png", "--kind", "neural", "--preset", "ba"}),
              testing::ElementsAre("balanced"));
  EXPECT_THAT(
      completed({"manual", "gramloom-c"}),
      testing::UnorderedElementsAre("gramloom-check", "gramloom-completion", "gramloom-config"));
}

TEST_F(Manual, CompletionsKnowWhatAConfigAndARunHave) {
  EXPECT_THAT(completed({"run", "c.toml", "--set", "method.q.patch"}),
              testing::ElementsAre("method.q.patch_size="));
  EXPECT_THAT(completed({"run", "--quiet", "--threads", "1", "c.toml", "--set", "method.n.octa"}),
              testing::ElementsAre("method.n.octaves="));
  EXPECT_THAT(completed({"check", "c.toml", "--only", "e/"}),
              testing::ElementsAre("e/q/seed1", "e/q/seed2"));
  EXPECT_EQ(run({"run", "c.toml", "--quiet", "--only", "e/q/seed2"}).exit_code, 0);
  EXPECT_THAT(completed({"pick", "out/c", ""}), testing::ElementsAre("e/q/seed2"));
  EXPECT_THAT(completed({"pick", "ou"}), testing::IsEmpty());
  EXPECT_THAT(completed({"run", "none.toml", "--only", ""}), testing::IsEmpty());
}

TEST_F(Manual, BashCompletes) {
  output_of({"completion", "zsh"});
  output_of({"completion", "fish"});
  write_text(folder_ / "gramloom.bash", output_of({"completion", "bash"}));
  EXPECT_EQ(shell(folder_, "bash -n gramloom.bash").exit_code, 0);
  const auto completed_by_bash = [&](const std::string& line) {
    const Outcome outcome = shell(
        folder_, fmt::format("bash -c 'source ./gramloom.bash; COMP_LINE=\"{0}\"; "
                             "COMP_POINT=${{#COMP_LINE}}; COMP_WORDS=(\"$GRAMLOOM\"); _gramloom; "
                             "echo \"${{COMPREPLY[*]}}\"'",
                             line));
    EXPECT_EQ(outcome.errors, "");
    return outcome.output;
  };
  EXPECT_EQ(completed_by_bash("gramloom ru"), "run\n");
  EXPECT_EQ(completed_by_bash("gramloom make e.png --tile "), "none x y both\n");
  EXPECT_EQ(completed_by_bash("gramloom run c.toml --set preset=ba"), "balanced\n");
  EXPECT_EQ(completed_by_bash("gramloom make e.png --set overla"), "overlap=\n");
  EXPECT_EQ(completed_by_bash("gramloom make e.png --output "), "\n");
  EXPECT_EQ(completed_by_bash("gramloom make e"), "e.png\n");
}

TEST_F(Manual, ListsAreJsonToo) {
  const Json methods = parse_json(output_of({"list", "methods", "--json"}));
  const std::vector<KeyList> lists = method_lists();
  ASSERT_EQ(methods.size(), lists.size());
  for (std::size_t m = 0; m < lists.size(); ++m) {
    EXPECT_EQ(methods[m]["name"], lists[m].name);
    ASSERT_EQ(methods[m]["parameters"].size(), lists[m].keys.size());
    for (std::size_t k = 0; k < lists[m].keys.size(); ++k) {
      const Json& key = methods[m]["parameters"][k];
      EXPECT_EQ(key["name"], lists[m].keys[k].name);
      for (const char* field : {"type", "default", "allowed", "unit", "description"})
        EXPECT_TRUE(key.contains(field)) << field;
    }
  }
  const auto find = [&](const std::string& method, const std::string& name) {
    for (const Json& one : methods)
      for (const Json& key : one["parameters"])
        if (one["name"] == method && key["name"] == name) return key;
    return Json();
  };
  EXPECT_EQ(find("quilting", "overlap")["default"], 0.45);
  EXPECT_EQ(find("quilting", "overlap")["max"], 0.5);
  EXPECT_EQ(find("neural", "preset")["words"][0], "fast");
  EXPECT_EQ(find("neural", "iterations")["type"], "list of integer");
  const Json all = parse_json(output_of({"list", "--json"}));
  for (const char* topic : {"methods", "patterns", "networks", "models", "metrics", "maps",
                            "direction", "simulation", "abilities"})
    EXPECT_FALSE(all[topic].empty()) << topic;
}

}  // namespace
}  // namespace gramloom
