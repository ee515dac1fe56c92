// [[preview]]: pictures of results on shapes, each of the jobs that it is for.
#include <gmock/gmock.h>

#include "jobs/job_config.h"
#include "jobs/job_preview.h"
#include "jobs/plan.h"
#include "jobs/run_folder.h"
#include "jobs/settings.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string two_solids =
    "size = 16\nscores = false\n"
    "[[method]]\nname = 'm'\nkind = 'procedural'\ntexture = 'marble'\nsamples = 1\n"
    "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'granite'\nsamples = 1\n";

// A small preview of this name, with more lines.
std::string shown(const std::string& name, const std::string& more = "") {
  return fmt::format("[[preview]]\nname = '{}'\nsize = 24\nsamples = 1\n{}", name, more);
}

class PreviewsOfJobs : public Runner {
 protected:
  std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) const {
    try {
      run_text(text, {}, set);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  std::vector<std::string> files(const std::string& job) const { return record(job).files; }
};

TEST_F(PreviewsOfJobs, EachIsMadeOfTheJobsThatItIsFor) {
  const std::string text =
      two_solids + shown("ball") + shown("cut", "shape = 'cube'\nonly = '*/m'\n");
  ASSERT_EQ(run_text(text).done, 2);
  EXPECT_EQ(
      files("procedural/m/seed1"),
      (std::vector<std::string>{"seed1.png", "seed1_preview_ball.png", "seed1_preview_cut.png"}));
  EXPECT_EQ(files("procedural/n/seed1"),
            (std::vector<std::string>{"seed1.png", "seed1_preview_ball.png"}));
  EXPECT_NE(read_image(out("procedural/m/seed1_preview_ball.png")).image,
            read_image(out("procedural/m/seed1_preview_cut.png")).image);
  EXPECT_EQ(record("procedural/m/seed1").settings["previews"]["cut"]["shape"], "cube");
  // Another cut is another result where it is made, and only there.
  EXPECT_EQ(resume(text).skipped, 2);
  const RunSummary again = resume(text, {"preview.cut.shape=cylinder"});
  EXPECT_EQ(again.done, 1);
  EXPECT_EQ(again.skipped, 1);
  EXPECT_EQ(resume(text, {"preview.size=20"}).done, 2) << "of all";
  EXPECT_EQ(read_image(out("procedural/n/seed1_preview_ball.png")).image.size(), (Size{20, 20}));
}

TEST_F(PreviewsOfJobs, OneMayHaveANameOrNone) {
  ASSERT_EQ(run_text(two_solids + "[preview]\nsize = 16\nsamples = 1\nonly = '*/n'\n").done, 2);
  EXPECT_THAT(files("procedural/n/seed1"), Contains("seed1_preview.png"));
  EXPECT_THAT(files("procedural/m/seed1"), Not(Contains("seed1_preview.png")));
  ASSERT_EQ(run_text(two_solids + "[preview]\nname = 'b'\nsize = 16\nsamples = 1\n").done, 2);
  EXPECT_THAT(files("procedural/n/seed1"), Contains("seed1_preview_b.png"));
}

TEST_F(PreviewsOfJobs, ASecondMaterialSharesTheShape) {
  const std::string solid = "mapping = 'solid'\n";
  ASSERT_EQ(run_text(two_solids + shown("one", solid) +
                     shown("two", solid + "second = 'wood'\npattern_repeat = 2\n"))
                .done,
            2);
  EXPECT_NE(read_image(out("procedural/m/seed1_preview_one.png")).image,
            read_image(out("procedural/m/seed1_preview_two.png")).image);
  // A picture, whose maps lie beside it: what they hold counts.
  const std::string text = two_solids + shown("p", "second = 'e.png'\npattern = 'stripes'\n");
  ASSERT_EQ(run_text(text).done, 2);
  EXPECT_EQ(resume(text).skipped, 2);
  write_image(folder_ / "e_roughness.png", Image(32, 32, 1, 0.1f), {});
  EXPECT_EQ(resume(text).done, 2);
  write_exemplar(2);
  EXPECT_EQ(resume(text).done, 2);
  const Json files = record("procedural/n/seed1").settings["previews"]["p"]["files"];
  EXPECT_TRUE(files.contains("second"));
  EXPECT_TRUE(files.contains("second_roughness"));
}

// A run that was stopped while it made them goes on: they are files of ours though no record knows
// them.
TEST_F(PreviewsOfJobs, OfAJobThatWasStoppedAreReplaced) {
  const std::string text = two_solids + shown("ball");
  ASSERT_EQ(run_text(text).done, 2);
  fs::remove(out("procedural/m/seed1.json"));
  EXPECT_EQ(resume(text).done, 1);
  // What others have put there is not.
  fs::remove(out("procedural/m/seed1_preview_ball.png"));
  fs::create_directory(out("procedural/m/seed1_preview_ball.png"));
  EXPECT_THAT(refusal(text), HasSubstr("seed1_preview_ball.png"));
  EXPECT_TRUE(fs::is_directory(out("procedural/m/seed1_preview_ball.png")));
}

TEST_F(PreviewsOfJobs, TheirOrderInTheConfigDoesNotCount) {
  const std::string a = shown("a"), b = shown("b", "shape = 'cube'\n");
  ASSERT_EQ(run_text(two_solids + a + b).done, 2);
  EXPECT_EQ(resume(two_solids + b + a).skipped, 2);
  const Json first = record("procedural/m/seed1").settings;
  ASSERT_EQ(run_text(two_solids + b + a).done, 2);
  EXPECT_EQ(to_text(record("procedural/m/seed1").settings), to_text(first));
}

TEST_F(PreviewsOfJobs, ASecondPictureCountsInTheEstimate) {
  const auto finishing = [&](const std::string& more) {
    return make_plan(parse_config(two_solids + shown("p", more), folder_ / "c.toml"))
        .jobs.front()
        .finishing;
  };
  write_image(folder_ / "large.png", Image(2000, 1000, 1), {});
  EXPECT_GT(finishing("second = 'large.png'\n").bytes, finishing("").bytes + 1e8);
  EXPECT_GT(seconds(finishing("second = 'large.png'\n").work), seconds(finishing("").work) + 0.2);
}

// The config of one job, as it is kept with its texture, asks for the job's previews and no others.
TEST_F(PreviewsOfJobs, AJobsOwnConfigHasThem) {
  const std::string text = two_solids + shown("ball", "second = 'e.png'\nenvironment = 'e.png'\n") +
                           shown("cut", "shape = 'cube'\nonly = '*/m'\n") + shown("plain");
  const Config all = parse_config(text, folder_ / "c.toml");
  FileHashes hashes;
  for (const PlannedJob& planned : list_jobs(all).jobs) {
    const Config own = parse_config(job_config(all, planned.job), folder_ / "own.toml");
    const Job job = list_jobs(own).jobs.front().job;
    EXPECT_EQ(job_settings(own, job, input_hashes(own, job, hashes)),
              job_settings(all, planned.job, input_hashes(all, planned.job, hashes)))
        << planned.name;
    const Json by_content =
        settings_by_content(job_settings(own, job, input_hashes(own, job, hashes)));
    const Json& ball = by_content["previews"]["ball"];
    EXPECT_FALSE(ball.contains("second")) << "a file's hash stands for it";
    EXPECT_FALSE(ball.contains("environment"));
    EXPECT_TRUE(ball["files"].contains("second"));
  }
}

TEST_F(PreviewsOfJobs, MistakesAreOneLineWithTheirPlace) {
  const auto says = [&](const std::string& previews, const std::string& line) {
    const std::string found = refusal(two_solids + previews);
    EXPECT_THAT(found, HasSubstr(line));
    EXPECT_THAT(found, HasSubstr("c.toml:"));
    EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0);
  };
  says(shown("a") + shown("a"), "name 'a' is there twice");
  says("[[preview]]\n[[preview]]\n", "a second [[preview]] without a 'name'");
  says(shown("a/b"), "'a/b'");
  says(shown("a", "only = 'x'\n"),
       "preview 'a': only = 'x' matches no job; there are procedural/m/seed1, …");
  says(shown("a", "pattern = 'stripes'\n"),
       "preview 'a': 'pattern' has no effect without 'second'");
  says(shown("a", "second = 'wod'\n"), "did you mean 'wood'?");
  says(shown("a", "second = 'none.png'\n"), "none.png");
  says(shown("a", "second = 'e.png'\nmapping = 'solid'\n"), "a picture is no solid");
  says(shown("a", "second = 'brick'\nmapping = 'solid'\n"), "preview 'a': ");
  says(shown("a", "shap = 'cube'\n"), "did you mean 'shape'?");
  write_image(folder_ / "s.png", Image(20, 20, 3), {});
  write_image(folder_ / "s_height.png", Image(10, 10, 1), {});
  says(shown("a", "second = 's.png'\n"), "10×10");
  says("[[preview]]\nname = ''\n", "empty");
  says("[[preview]]\nrepeat = 2\nmapping = 'solid'\n", "preview: ");
  EXPECT_THAT(refusal(two_solids + "preview = 3\n"), HasSubstr("preview"));
  EXPECT_THAT(refusal(two_solids + shown("ball"), {"preview.bal.shape=cube"}),
              HasSubstr("no preview is called 'bal' (did you mean 'ball'?)"));
  EXPECT_THAT(refusal(two_solids, {"preview.bal.shape=cube"}), HasSubstr("none has a name"));
  EXPECT_THAT(refusal("[[exemplar]]\nname = 'e'\nimage = 'e.png'\nmaps = { Preview_a = 'e.png' }\n"
                      "[[method]]\nname = 'b'\nkind = 'quilting'\n" +
                      shown("a")),
              HasSubstr("the map 'Preview_a' of 'e' would have the file of the preview 'a'"));
  EXPECT_THAT(refusal(two_solids, {"preview.repeat=2", "preview.mapping=solid"}),
              HasSubstr("--set preview."));
}

}  // namespace
}  // namespace gramloom
