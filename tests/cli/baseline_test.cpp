// gramloom run --baseline from outside, on the golden baseline and on broken ones.
#include "cli/workspace.h"
#include "source_folder.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

const fs::path golden = source_folder() / "tests/golden";

class BaselineRun : public Workspace {
 protected:
  void damage_picture(const std::string& name) const {
    ImageFile file = read_image(folder_ / name);
    for (float& value : file.image.pixels) value = 1 - value;
    write_image(folder_ / name, file.image, file.encoding, file.metadata);
  }
  void damage_score(const std::string& job, const std::string& metric, double value) const {
    JobRecord record = read_record(folder_ / job);
    record.metrics[metric] = value;
    write_record(folder_ / job, record);
  }
  Outcome compare(const std::string& baseline) const {
    return run({"run", "c.toml", "--quiet", "--output", "now", "--baseline", baseline});
  }
};

TEST_F(BaselineRun, TheGoldenBaselineHolds) {
  const Outcome outcome = run({"run", (golden / "golden.toml").string(), "--quiet", "--output",
                               "now", "--baseline", (golden / "baseline").string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
}

TEST_F(BaselineRun, DamageToPicturesAndScoresIsFound) {
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--output", "before"}).exit_code, 0);
  const Outcome same = compare("before");
  EXPECT_EQ(same.exit_code, 0) << same.output;
  EXPECT_EQ(same.output, "");

  damage_picture("before/e/q/seed1.png");
  damage_score("before/e/q/seed2.json", "spectrum_db", 0.01);
  const Outcome outcome = compare("before");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.output.find("worse  e/q/seed1  seed1.png"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("worse  e/q/seed2  spectrum_db  0.01"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("4 jobs against before: 2 worse, 2 changes in all\n"),
            std::string::npos)
      << outcome.output;
  const Json json = Json::parse(file("now/baseline.json"));
  EXPECT_EQ(json["worse"], 2);
  EXPECT_EQ(json["changes"][0]["job"], "e/q/seed1");

  const Outcome other =
      run({"run", "c.toml", "--quiet", "--output", "now", "--baseline", "before", "--only", "*/n"});
  EXPECT_EQ(other.exit_code, 0) << other.output;
}

TEST_F(BaselineRun, ThePageShowsWhatChangedAndKeepsTheEarlierPictures) {
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--output", "before"}).exit_code, 0);
  damage_picture("before/e/q/seed1.png");
  damage_score("before/e/q/seed2.json", "stsim2", 0.98765);
  const std::string earlier = file("before/e/q/seed1.png");
  compare("before");
  const Json json = Json::parse(file("now/baseline.json"));
  EXPECT_EQ(json["folder"], "../before");
  ASSERT_EQ(json["jobs"].size(), 2u);
  EXPECT_EQ(json["jobs"][0]["job"], "e/q/seed1");
  EXPECT_EQ(json["jobs"][0]["pictures"][0]["now"], "e/q/seed1.png");
  EXPECT_EQ(json["jobs"][1]["scores"], (Json{{"stsim2", 0.98765}}));
  EXPECT_TRUE(file("now/page/before/e/q/seed1.png") == earlier);
  const auto shows = [&](const std::string& text) {
    EXPECT_THAT(file("now/index.html"), testing::HasSubstr(text));
  };
  shows("\"before\":\"page/before/e/q/seed1.png\"");
  shows("\"stsim2\":0.98765");

  // The earlier run is gone: its pictures that the page shows are not.
  fs::rename(folder_ / "before", folder_ / "elsewhere");
  EXPECT_EQ(run({"report", "now"}).exit_code, 0);
  shows("\"before\":\"page/before/e/q/seed1.png\"");
  fs::remove_all(folder_ / "now/page/before");
  EXPECT_EQ(run({"report", "now"}).exit_code, 0);
  shows("\"before\":null");
  // What is there now is no longer what was compared.
  fs::rename(folder_ / "elsewhere", folder_ / "before");
  damage_picture("before/e/q/seed1.png");
  EXPECT_EQ(run({"report", "now"}).exit_code, 0);
  shows("\"before\":null");

  // One of an older gramloom is read.
  Json old = json;
  old["version"] = 2;
  old.erase("folder");
  old.erase("jobs");
  write_text(folder_ / "now/baseline.json", old.dump());
  EXPECT_EQ(run({"report", "now"}).exit_code, 0);
  shows("\"old\":true");

  // Another run into the folder: the comparison no longer holds.
  EXPECT_EQ(run({"run", "c.toml", "--quiet", "--output", "now", "--resume"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "now/baseline.json"));
  shows("\"baseline\":null");
}

TEST_F(BaselineRun, ABaselineThatIsMissingOrBrokenIsFoundBeforeTheRun) {
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--output", "whole"}).exit_code, 0);
  const auto broken = [&](const std::string& name, const std::string& text) {
    fs::remove_all(folder_ / "broken");
    fs::copy(folder_ / "whole", folder_ / "broken", fs::copy_options::recursive);
    text.empty() ? void(fs::remove(folder_ / "broken" / name))
                 : write_text(folder_ / "broken" / name, text);
    return compare("broken");
  };
  for (const Outcome& outcome :
       {compare("nowhere"), compare("e.png"), compare("now"), broken("run.json", ""),
        broken("run.json", "{\"jobs\": 3}"), broken("run.json", "no JSON"),
        broken("e/q/seed1.json", ""), broken("e/q/seed2.json", "{}"), broken("e/q/seed1.png", ""),
        broken("e/q/seed1.png", "no picture")}) {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
    EXPECT_TRUE(outcome.errors.starts_with("--baseline ")) << outcome.errors;
  }
  EXPECT_FALSE(fs::exists(folder_ / "now"));

  const Outcome itself =
      run({"run", "c.toml", "--output", "whole", "--baseline", "whole/../whole"});
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_NE(itself.errors.find("write over it"), std::string::npos) << itself.errors;
}

TEST_F(BaselineRun, ABaselineWithoutAFinishedJobIsAnError) {
  ASSERT_EQ(run({"run", "c.toml", "--quiet", "--output", "whole"}).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "whole"))
    if (entry.path().filename().string().starts_with("seed") &&
        entry.path().extension() == ".json") {
      JobRecord record = read_record(entry.path());
      record.status = Status::failed;
      write_record(entry.path(), record);
    }
  const Outcome outcome = compare("whole");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  EXPECT_NE(outcome.errors.find("no job of it is finished"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace gramloom
