#include "jobs/runner.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/hash.h"
#include "jobs/inputs.h"
#include "jobs/machine.h"
#include "jobs/run_folder.h"
#include "runs/format.h"
#include "runs/run_record.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

TEST_F(Runner, LeavesPictureRecordAndRunFile) {
  EXPECT_EQ(run_text(two_textures).done, 2);
  const JobRecord noise = record("procedural/a/seed1");
  EXPECT_EQ(noise.status, Status::done);
  EXPECT_EQ(noise.error, "");
  EXPECT_EQ(noise.kind, "procedural");
  EXPECT_GT(noise.peak_memory_mb, 1);
  const ImageFile picture = read_image(out("e/b/seed1.png"));
  EXPECT_EQ(picture.image.size(), (Size{24, 16}));
  const Json made_by = Json::parse(picture.metadata.at("gramloom:settings"));
  EXPECT_EQ(made_by["method"]["patch_size"], 8);
  EXPECT_EQ(made_by["exemplar"]["image"], "e.png");
  const Json run_json = Json::parse(read_text(out("run.json")));
  EXPECT_EQ(run_json["jobs"]["e/b/seed1"]["status"], "done");
  EXPECT_EQ(run_json["config_text"], two_textures);
  EXPECT_FALSE(run_json["versions"]["gramloom"].empty());
}

TEST_F(Runner, TheSameSeedGivesTheSameFileAndAnotherOneDoesNot) {
  run_text(two_textures, {}, {"seeds=[1,2]"});
  const std::string first = read_text(out("e/b/seed1.png"));
  EXPECT_NE(read_text(out("e/b/seed2.png")), first);
  fs::remove_all(folder_ / "out");
  run_text(two_textures, {}, {"seeds=[2,1]"});
  EXPECT_EQ(read_text(out("e/b/seed1.png")), first);
}

TEST_F(Runner, PixelTypeOfTheExemplarUnlessTheConfigSaysOtherwise) {
  write_exemplar(1, {PixelType::uint16, "", {}});
  run_text(two_textures);
  EXPECT_EQ(read_image(out("e/b/seed1.png")).encoding.pixel_type, PixelType::uint16);
  run_text(two_textures, {}, {"pixel_type=float"});
  EXPECT_EQ(read_image(out("e/b/seed1.exr")).encoding.pixel_type, PixelType::float32);
  EXPECT_FALSE(fs::exists(out("e/b/seed1.png"))) << "the picture that was replaced";
  run_text(two_textures, {}, {"pixel_type=uint8", "format=tif"});
  EXPECT_EQ(read_image(out("e/b/seed1.tif")).encoding.pixel_type, PixelType::uint8);
}

TEST_F(Runner, ManyChannelsBecomeTiff) {
  Image image(16, 16, 7, 0.25f);
  write_image(folder_ / "e.tif", image, {});
  const std::vector<std::string> set{"exemplar.e.image=" + (folder_ / "e.tif").string()};
  run_text(two_textures, {}, set);
  EXPECT_EQ(read_image(out("e/b/seed1.tif")).image.channels, 7);
  auto with_png = set;
  with_png.push_back("format=png");
  EXPECT_EQ(run_text(two_textures, {}, with_png).failed, 1);
  EXPECT_NE(record("e/b/seed1").error.find("7 channels"), std::string::npos);
}

TEST_F(Runner, AFailedJobDoesNotStopTheOthers) {
  write_text(folder_ / "e.png", "no picture");
  const RunSummary summary =
      run_text(two_textures + "[[exemplar]]\nname = 'z'\nimage = 'out.png'\n", {},
               {"exemplar.z.image=" + [&] {
                 write_image(folder_ / "z.png", Image(32, 32, 3, 0.5f), {});
                 return (folder_ / "z.png").string();
               }()});
  EXPECT_EQ(summary.failed, 1);
  EXPECT_EQ(summary.done, 2);
  const JobRecord failed = record("e/b/seed1");
  EXPECT_EQ(failed.status, Status::failed);
  EXPECT_NE(failed.error.find("e.png"), std::string::npos);
  EXPECT_EQ(failed.error.find('\n'), std::string::npos);
  EXPECT_EQ(record("z/b/seed1").status, Status::done);
}

TEST_F(Runner, ResumeSkipsWhatIsFinished) {
  run_text(two_textures);
  const auto time = fs::last_write_time(out("e/b/seed1.png"));
  EXPECT_EQ(resume(two_textures).skipped, 2);
  EXPECT_EQ(fs::last_write_time(out("e/b/seed1.png")), time);
}

TEST_F(Runner, ResumeRedoesWhatChanged) {
  run_text(two_textures);
  EXPECT_EQ(resume(two_textures, {"patch_size=9"}).done, 1) << "a parameter of one method";
  EXPECT_EQ(resume(two_textures, {"patch_size=9", "tile=x"}).done, 2) << "the target";
  const std::vector<std::string> set{"patch_size=9", "tile=x"};
  write_exemplar(2);
  EXPECT_EQ(resume(two_textures, set).done, 1) << "the exemplar's pixels";
  fs::remove(out("procedural/a/seed1.png"));
  EXPECT_EQ(resume(two_textures, set).done, 1) << "a picture that is gone";
  write_text(out("e/b/seed1.json"), "{\"status\": \"done\"");
  EXPECT_EQ(resume(two_textures, set).done, 1) << "a record that is not whole";
  EXPECT_EQ(resume(two_textures, set).skipped, 2);
}

TEST_F(Runner, ResumeRedoesANeuralJobWhoseNetworkWasEdited) {
  const std::string network =
      "name = \"own\"\nsummary = \"\"\nmatched = [\"c\"]\n"
      "[[layer]]\nname = \"c\"\ntype = \"convolution\"\nchannels = 4\nkernel = 3\n";
  write_text(folder_ / "own.toml", network);
  const std::string config =
      "size = [24, 16]\nscores = false\n[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
      "[[method]]\nname = 'n'\nkind = 'neural'\nnetwork = 'own.toml'\niterations = 2\n";
  const std::vector<std::string> looks_at_it{"sliced_weight=0", "gram_weight=1"};
  run_text(config, {}, looks_at_it);
  EXPECT_EQ(resume(config, looks_at_it).skipped, 1);
  write_text(folder_ / "own.toml", network + "[[layer]]\nname = \"r\"\ntype = \"relu\"\n");
  EXPECT_EQ(resume(config, looks_at_it).done, 1);
  EXPECT_EQ(resume(config, looks_at_it).skipped, 1);
  const JobRecord found = record("e/n/seed1");
  ASSERT_TRUE(found.network);
  EXPECT_EQ(found.network->text, read_text(folder_ / "own.toml"));
  EXPECT_EQ(found.settings["files"]["network"], file_hash(folder_ / "own.toml"));
}

TEST_F(Runner, ARecordSaysWhatItDependedOn) {
  const std::vector<std::string> set{"patch_size=9"};
  run_text(two_textures, {}, set);
  const JobRecord found = record("e/b/seed1");
  EXPECT_EQ(found.machine, machine());
  EXPECT_EQ(found.versions, versions());
  EXPECT_EQ(found.config, (folder_ / "c.toml").string());
  EXPECT_EQ(found.config_hash, hash_of(two_textures));
  EXPECT_EQ(found.set, set);
  EXPECT_EQ(found.settings["exemplar"]["hash"], file_hash(folder_ / "e.png"));
  EXPECT_EQ(found.texture, file_hash(out("e/b/seed1.png")));
  EXPECT_FALSE(found.network);
}

TEST_F(Runner, ResumeRedoesWhatAnotherVersionMadeButNotForOtherThreadsOrMachines) {
  run_text(two_textures);
  JobRecord changed = record("e/b/seed1");
  changed.machine = {"another processor", 99, 99, "1 kB"};
  for (auto& [name, text] : changed.versions)
    if (name != "gramloom") text = "another";
  write_record(out("e/b/seed1.json"), changed);
  EXPECT_EQ(resume(two_textures).skipped, 2);
  for (auto& [name, text] : changed.versions)
    if (name == "gramloom") text = "0.0.1";
  write_record(out("e/b/seed1.json"), changed);
  EXPECT_EQ(resume(two_textures).done, 1);
}

TEST_F(Runner, AnExemplarThatChangesDuringTheRunIsHashedAsItWasRead) {
  RunOptions options;
  int asked = 0;
  // Between the two jobs: the exemplar was planned with, but is not read yet.
  options.stop = [&] {
    if (++asked == 1) write_exemplar(2);
    return false;
  };
  run_text(two_textures, options);
  EXPECT_EQ(record("e/b/seed1").settings["exemplar"]["hash"], file_hash(folder_ / "e.png"));
  EXPECT_EQ(resume(two_textures).skipped, 2);
}

TEST_F(Runner, RunFilesAreNotWrittenForEachJob) {
  std::string seeds = "seeds=[1";
  for (int seed = 2; seed <= 60; ++seed) seeds += fmt::format(",{}", seed);
  const std::vector<std::string> set{seeds + "]", "scores=false", "size=8"};
  for (const bool again : {false, true}) {
    const auto start = std::chrono::steady_clock::now();
    const RunSummary summary = again ? resume(two_textures, set) : run_text(two_textures, {}, set);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(again ? summary.skipped : summary.done, 120);
    // At the start, at the end, and once a second.
    EXPECT_LE(summary.writes, 2 + seconds.count());
    EXPECT_GE(summary.writes, 1);
  }
  const auto run = read_format<RunRecord>(out("run.json"));
  ASSERT_EQ(run.jobs.size(), 120u);
  for (const auto& [name, standing] : run.jobs) EXPECT_EQ(standing.status, Status::done) << name;
}

TEST_F(Runner, ADamagedRecordIsDoneAgain) {
  run_text(two_textures);
  const std::string whole = read_text(out("e/b/seed1.json"));
  for (const std::string text : {"", "[]", "{}", "{\"status\": 3}"}) {
    write_text(out("e/b/seed1.json"), text);
    EXPECT_EQ(resume(two_textures).done, 1) << text;
  }
}

TEST_F(Runner, AStopBetweenJobsLeavesTheRestForResume) {
  int asked = 0;
  RunOptions options;
  options.stop = [&] { return ++asked > 1; };
  const RunSummary summary = run_text(two_textures, options);
  EXPECT_EQ(summary.done + summary.interrupted, 1);
  EXPECT_EQ(summary.left, 1);
  const RunSummary rest = resume(two_textures);
  EXPECT_EQ(rest.failed + rest.interrupted + rest.left, 0);
  EXPECT_EQ(record("e/b/seed1").status, Status::done);
  EXPECT_EQ(record("procedural/a/seed1").status, Status::done);
}

TEST_F(Runner, AFinishedResultOutlivesAnInterruptedAttemptToRedoIt) {
  run_text(two_textures);
  const std::string before = read_text(out("procedural/a/seed1.png"));
  int asked = 0;
  RunOptions options;
  options.stop = [&] { return ++asked > 1; };  // the first time is before the first job
  EXPECT_EQ(run_text(two_textures, options, {"size=512"}).interrupted, 1);
  EXPECT_EQ(read_text(out("procedural/a/seed1.png")), before);
  EXPECT_EQ(record("procedural/a/seed1").status, Status::done);
}

TEST_F(Runner, AnOutputThatCannotBeWrittenIsFoundBeforeAnyWork) {
  write_text(folder_ / "out", "a file where the folder should be");
  EXPECT_THROW(run_text(two_textures), ConfigError);
}

TEST_F(Runner, AFileInTheWayOfAJobFailsThatJobOnly) {
  fs::create_directories(folder_ / "out");
  write_text(out("e"), "a file where a folder should be");
  const RunSummary summary = run_text(two_textures);
  EXPECT_EQ(summary.failed, 1);
  EXPECT_EQ(summary.done, 1);
}

}  // namespace
}  // namespace gramloom
