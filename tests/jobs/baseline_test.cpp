#include <gtest/gtest.h>
#include <unistd.h>

#include "io/image_file.h"
#include "jobs/baseline_compare.h"
#include "jobs/config.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

// Two runs of one finished job, which a test makes differ.
class BaselineTest : public testing::Test {
 protected:
  BaselineTest()
      : folder_(fs::temp_directory_path() / fmt::format("gramloom_baseline_{}", getpid())) {
    fs::remove_all(folder_);
    JobRecord record;
    record.exemplar = "e";
    record.method = "m";
    record.status = Status::done;
    record.settings = {{"method", {{"kind", "quilting"}, {"patch_size", 8}}}, {"seed", 1}};
    record.metrics = {
        {"stsim2", 0.9}, {"spectrum_db", 2.0}, {"copied_share", 0.0}, {"seam_x", 0.5}};
    record.files = {"seed1.png"};
    before_ = {folder_ / "before", {{job_, record}}, {{"e", "m", {1, 2}, 0.8, ""}}};
    now_ = {folder_ / "now", {{job_, record}}, {{"e", "m", {1, 2}, 0.8, ""}}};
    for (const auto& run : {before_, now_}) fs::create_directories(run.folder / "e/m");
    write(before_, picture_);
    write(now_, picture_);
  }
  ~BaselineTest() override { fs::remove_all(folder_); }

  void write(const Baseline& run, const Image& image) const {
    write_image(run.folder / "e/m/seed1.png", image, {});
  }
  JobRecord& now() { return now_.jobs.at(job_); }
  std::vector<Change> changes() const { return compare(before_, now_, limits_); }
  // The verdict on the only thing that changed, after its name; "" when nothing did.
  std::string verdict() const {
    const auto found = changes();
    EXPECT_LE(found.size(), 1u) << change_table(found, before_, now_);
    return found.empty() ? "" : fmt::format("{} {}", found[0].what, to_word(found[0].verdict));
  }

  const std::string job_ = "e/m/seed1";
  const fs::path folder_;
  const Image picture_ = Image(20, 10, 3, 0.4f);
  Baseline before_;
  Baseline now_;
  BaselineLimits limits_;
};

TEST_F(BaselineTest, EqualRunsHaveNoChanges) { EXPECT_EQ(verdict(), ""); }

TEST_F(BaselineTest, ManyPixelsOverTheToleranceAreWorse) {
  Image image = picture_;
  for (int x = 0; x < 2; ++x) image.at(x, 3)[1] += 0.05f;  // 2 of 200 pixels
  write(now_, image);
  EXPECT_EQ(verdict(), "");
  image.at(2, 3)[2] += 0.05f;
  write(now_, image);
  EXPECT_EQ(verdict(), "seed1.png worse");
  limits_.pixel_share = 0.015;
  EXPECT_EQ(verdict(), "");
  limits_.pixel_share = 0;
  limits_.pixel_tolerance = 0.06;
  EXPECT_EQ(verdict(), "");
}

TEST_F(BaselineTest, OnePixelFarOffIsWorse) {
  Image image = picture_;
  image.at(7, 3)[1] += 0.3f;
  write(now_, image);
  EXPECT_EQ(verdict(), "seed1.png worse");
  limits_.pixel_limit = 0.4;
  EXPECT_EQ(verdict(), "");
}

TEST_F(BaselineTest, AnotherShapeIsWorse) {
  write(now_, Image(20, 11, 3, 0.4f));
  EXPECT_EQ(verdict(), "seed1.png worse");
  write(now_, Image(20, 10, 1, 0.4f));
  EXPECT_EQ(verdict(), "seed1.png worse");
}

TEST_F(BaselineTest, OtherSettingsExcuseOtherPixels) {
  write(now_, Image(20, 10, 3, 0.9f));
  now().settings["method"]["patch_size"] = 9;
  const auto found = changes();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].what, "method/patch_size");
  EXPECT_EQ(found[0].before, "8");
  EXPECT_EQ(found[0].now, "9");
  EXPECT_EQ(count_worse(found), 0u);
}

TEST_F(BaselineTest, ASettingThatANewVersionAddsExcusesNothing) {
  write(now_, Image(20, 10, 3, 0.9f));
  now().settings["method"]["feather"] = 0;
  const auto found = changes();
  EXPECT_EQ(found.size(), 2u);
  EXPECT_EQ(count_worse(found), 1u);
}

TEST_F(BaselineTest, ScoresAreJudgedByTheirDistanceFromTheBest) {
  now().metrics["stsim2"] = 0.905;  // a distance of 0.095 in place of 0.1
  EXPECT_EQ(verdict(), "");
  now().metrics["stsim2"] = 0.88;
  EXPECT_EQ(verdict(), "stsim2 worse");
  now().metrics["stsim2"] = 0.92;
  EXPECT_EQ(verdict(), "stsim2 better");
  now().metrics["stsim2"] = 0.9;
  now().metrics["spectrum_db"] = 2.3;
  EXPECT_EQ(verdict(), "spectrum_db worse");
  limits_.score_change = 0.2;
  EXPECT_EQ(verdict(), "");
  now().metrics["spectrum_db"] = 1.0;
  EXPECT_EQ(verdict(), "spectrum_db better");
}

TEST_F(BaselineTest, NearTheBestAndBeyondItChangesDoNotCount) {
  now().metrics["copied_share"] = 0.001;
  EXPECT_EQ(verdict(), "") << "infinitely much more than 0, and yet nothing";
  now().metrics["copied_share"] = 0.01;
  EXPECT_EQ(verdict(), "copied_share worse");
  now().metrics["copied_share"] = 0.0;
  now().metrics["seam_x"] = 0.95;
  EXPECT_EQ(verdict(), "") << "a seam up to 1 is invisible";
  now().metrics["seam_x"] = 1.1;
  EXPECT_EQ(verdict(), "seam_x worse");
}

TEST_F(BaselineTest, ScoresThatAreGone) {
  now().metrics.clear();
  EXPECT_EQ(verdict(), "") << "this run was asked for none";
  now().score_error = "out of memory";
  EXPECT_EQ(verdict(), "scores worse");
}

TEST_F(BaselineTest, Diversity) {
  now_.diversity[0].value = 0.5;
  EXPECT_EQ(verdict(), "diversity worse");
  now_.diversity[0].seeds = {1, 2, 3};
  EXPECT_EQ(verdict(), "") << "of other seeds";
}

TEST_F(BaselineTest, JobsThatFailVanishOrCome) {
  now().status = Status::failed;
  EXPECT_EQ(verdict(), "status worse");
  std::swap(before_, now_);
  EXPECT_EQ(verdict(), "status better");
  const JobRecord job = now();
  now_.jobs.clear();
  before_.jobs.at(job_).status = Status::done;
  EXPECT_EQ(verdict(), "job worse");
  before_.jobs.clear();
  now_.jobs.emplace(job_, job);
  EXPECT_EQ(verdict(), "job changed");
}

TEST(BaselineLimits, ComeFromTheConfigAndFromSet) {
  const std::string text =
      "[[method]]\nname = 'a'\nkind = 'procedural'\ntexture = 'noise'\n"
      "[baseline]\npixel_share = 0.5\nscore_change = 1\n";
  const Config config = parse_config(text, "c.toml", {"baseline.score_change=2"});
  EXPECT_EQ(config.baseline.pixel_share, 0.5);
  EXPECT_EQ(config.baseline.score_change, 2);
  EXPECT_EQ(config.baseline.pixel_limit, BaselineLimits{}.pixel_limit);
  for (const std::string wrong : {"baseline.pixels=1", "baseline.pixel_share=2", "baseline=1"})
    EXPECT_THROW(parse_config(text, "c.toml", {wrong}), ConfigError) << wrong;
  EXPECT_THROW(parse_config("[[baseline]]\n" + text.substr(0, text.find("[baseline]")), "c.toml"),
               ConfigError);
}

}  // namespace
}  // namespace gramloom
