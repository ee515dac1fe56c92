// gramloom benchmark from outside.
#include "cli/workspace.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

// Two exemplars from a folder, two methods, two seeds. The run is done once for all tests.
class BenchmarkCommand : public Workspace {
 protected:
  BenchmarkCommand() {
    const auto all = fs::copy_options::recursive | fs::copy_options::overwrite_existing;
    const bool is_done = fs::exists(done());
    if (!is_done) do_run();
    fs::copy(is_done ? done() : folder_, is_done ? folder_ : done(), all);
  }
  static void TearDownTestSuite() { fs::remove_all(done()); }

  static fs::path done() {
    return fs::temp_directory_path() / fmt::format("gramloom_benchmark_{}", getpid());
  }

  void do_run() const {
    fs::create_directory(folder_ / "set");
    fs::copy_file(folder_ / "e.png", folder_ / "set" / "a.png");
    fs::copy_file(folder_ / "e.png", folder_ / "set" / "b.png");
    write_text(folder_ / "b.toml",
               "seeds = [1, 2]\nsize = [40, 24]\ntile = 'x'\n"
               "[[exemplar]]\nname = 'set'\nfolder = 'set'\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\npatch_size = 8\n"
               "[[method]]\nname = 'h'\nkind = 'histogram'\n"
               "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n");
    EXPECT_EQ(run({"run", "b.toml", "--quiet"}).exit_code, 0);
  }

  // A folder with pictures of a peer.
  void add_peer(const std::string& name, const std::vector<std::string>& pictures) const {
    for (const std::string& picture : pictures) {
      fs::create_directories((folder_ / name / picture).parent_path());
      fs::copy_file(folder_ / "e.png", folder_ / name / picture);
    }
  }
};

TEST_F(BenchmarkCommand, ARowAMethodWithIntervals) {
  const Outcome table = run({"benchmark", "out/b"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_EQ(table.errors, "");
  std::vector<std::string> starts;
  for (std::size_t at = 0; at < table.output.size(); at = table.output.find('\n', at) + 1)
    starts.push_back(table.output.substr(at, table.output.find_first_of(" \n", at) - at));
  EXPECT_EQ(starts, (std::vector<std::string>{"method", "better", "q", "h", "", "Means"}));
  for (const std::string word :
       {"stsim2", "copied_share", "diversity", "seam", "seconds", " ± ", "more", "less"})
    EXPECT_NE(table.output.find(word), std::string::npos) << word << "\n" << table.output;
  const Outcome markdown = run({"benchmark", "out/b", "--markdown"});
  EXPECT_TRUE(markdown.output.starts_with("| method | exemplars | stsim2 |")) << markdown.output;
  EXPECT_NE(markdown.output.find("\n|---|---|"), std::string::npos);
}

TEST_F(BenchmarkCommand, PeersStandBesideWithWhatTheirPicturesTell) {
  add_peer("copies", {"a.png", "b/1.png", "b/2.png", "c.png"});
  const Outcome outcome = run({"benchmark", "out/b", "--peer", "copier=copies", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const Json json = Json::parse(outcome.output);
  const Json& copier = json["copier"];
  EXPECT_EQ(copier["stsim2"], (Json{{"mean", 1.0}, {"half_width", 0.0}, {"exemplars", 2}}));
  EXPECT_EQ(copier["copied_share"]["mean"], 1.0);
  EXPECT_NEAR(copier["diversity"]["mean"].get<double>(), 0, 1e-6);
  EXPECT_EQ(copier["diversity"]["exemplars"], 1);  // b alone has two pictures
  EXPECT_TRUE(copier["diversity"]["half_width"].is_null());
  EXPECT_TRUE(copier.contains("seam"));
  EXPECT_FALSE(copier.contains("seconds"));
  EXPECT_TRUE(json["q"].contains("seconds"));
}

TEST_F(BenchmarkCommand, AMissingOrBrokenPictureOfAPeerIsSaid) {
  add_peer("half", {"b.png"});
  add_peer("broken", {"a.png"});
  write_text(folder_ / "broken" / "b.png", "no picture");
  const Outcome outcome =
      run({"benchmark", "out/b", "--peer", "half=half", "--peer", "broken=broken", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.errors.find("peer half: half has no picture of the exemplar 'a'\n"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("peer broken: broken/b.png: "), std::string::npos)
      << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 2) << outcome.errors;
  const Json json = Json::parse(outcome.output);
  EXPECT_EQ(json["half"]["stsim2"]["exemplars"], 1);
  EXPECT_EQ(json["broken"]["stsim2"]["exemplars"], 1);
}

TEST_F(BenchmarkCommand, JobsThatAreNotDoneAreSaidAndLeftOut) {
  write_text(folder_ / "out/b/a/q/seed1.json", "damaged");
  fs::remove(folder_ / "out/b/b/q/seed2.json");
  const Outcome outcome = run({"benchmark", "out/b", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_TRUE(outcome.errors.starts_with("gramloom: q: without 2 of 4 jobs: a/q/seed1 (failed: "))
      << outcome.errors;
  EXPECT_EQ(Json::parse(outcome.output)["q"]["stsim2"]["exemplars"], 2);
}

TEST_F(BenchmarkCommand, OfAPartOfARunThatPartIsCompared) {
  ASSERT_EQ(run({"run", "b.toml", "--quiet", "--only", "a/q", "--output", "out/part"}).exit_code,
            0);
  const Outcome outcome = run({"benchmark", "out/part", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
  const Json json = Json::parse(outcome.output);
  EXPECT_EQ(json.size(), 1u);
  EXPECT_EQ(json["q"]["stsim2"]["exemplars"], 1);
}

TEST_F(BenchmarkCommand, DifferencesFromOneMethod) {
  const Outcome outcome = run({"benchmark", "out/b", "--against", "q"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("differences from 'q'"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("-0."), std::string::npos) << outcome.output;
}

TEST_F(BenchmarkCommand, MistakesAreOneLineAndExitCode2) {
  add_peer("copies", {"a.png"});
  add_peer("others", {"x.png"});
  EXPECT_EQ(
      run({"run", "b.toml", "--quiet", "--set", "scores=false", "--output", "out/none"}).exit_code,
      0);
  const std::vector<std::vector<std::string>> mistakes{
      {},
      {"out"},
      {"out/none"},
      {"out/b", "--against", "k"},
      {"out/b", "--peer", "copies"},
      {"out/b", "--peer", "=copies"},
      {"out/b", "--peer", "p=gone"},
      {"out/b", "--peer", "p=others"},
      {"out/b", "--peer", "q=copies"},
      {"out/b", "--peer", "p=copies", "--peer", "p=copies"},
      {"out/b", "--json", "--markdown"},
  };
  for (auto words : mistakes) {
    words.insert(words.begin(), "benchmark");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 2) << fmt::format("{}", fmt::join(words, " "));
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
  }
}

}  // namespace
}  // namespace gramloom
