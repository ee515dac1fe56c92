// Runs that are stopped, killed and resumed.
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "cli/workspace.h"
#include "jobs/trace_log.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Interruption : public Workspace {
 protected:
  // A job of a minute in many short steps, between which a busy machine looks up too; and a short
  // job after it.
  void write_long_config() const {
    write_text(folder_ / "long.toml",
               "size = [400, 400]\n"
               "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
               "[[method]]\nname = 'long'\nkind = 'patchmatch'\niterations = 1000\n"
               "[[method]]\nname = 'next'\nkind = 'quilting'\npatch_size = 8\n");
  }

  void wait_for_file(const fs::path& file) const {
    for (int i = 0; i < 12000 && !fs::exists(folder_ / file); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(fs::exists(folder_ / file)) << file;
  }

  // Every result under `out` is whole; the finished jobs' pictures by path, with their time.
  std::map<fs::path, fs::file_time_type> finished_pictures(const fs::path& out) const {
    std::map<fs::path, fs::file_time_type> finished;
    if (!fs::exists(folder_ / out)) return finished;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / out)) {
      const fs::path& path = entry.path();
      if (path.filename().string().starts_with('.')) continue;  // temporary
      if (path.extension() == ".png") {
        EXPECT_NO_THROW(read_image(path)) << path;
      } else if (path.extension() == ".json") {
        EXPECT_TRUE(Json::accept(read_text(path))) << path;
        const auto record = find_record(path);
        if (record && record->status == Status::done)
          for (const auto& name : record->files) {
            const fs::path picture = path.parent_path() / name;
            EXPECT_TRUE(fs::exists(picture)) << picture;
            finished[picture] = fs::last_write_time(picture);
          }
      }
    }
    return finished;
  }
};

TEST_F(Interruption, CtrlCStopsAndSaysSo) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    write_long_config();
    fs::remove_all(folder_ / "out");
    Process process(folder_, {"run", "long.toml"});
    wait_for_file("out/long/e/long/seed1.json");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    process.signal(signal);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
    ASSERT_TRUE(record("e/long/seed1", "out/long"));
    EXPECT_EQ(record("e/long/seed1", "out/long")->status, Status::interrupted);
    EXPECT_FALSE(record("e/next/seed1", "out/long"));
    const Json run_json = Json::parse(file("out/long/run.json"));
    EXPECT_EQ(run_json["jobs"]["e/long/seed1"]["status"], "interrupted");
    EXPECT_EQ(run_json["jobs"]["e/next/seed1"]["status"], "waiting");
  }
}

TEST_F(Interruption, TheSecondCtrlCEndsTheProcessAtOnce) {
  write_long_config();
  Process process(folder_, {"run", "long.toml"});
  wait_for_file("out/long/e/long/seed1.json");
  process.signal(SIGHUP);
  process.signal(SIGTERM);
  process.signal(SIGINT);
  const int exit_code = process.wait().exit_code;
  EXPECT_TRUE(exit_code == 130 || exit_code == 128 + SIGTERM) << exit_code;
  EXPECT_EQ(record("e/long/seed1", "out/long")->status, Status::interrupted);
}

TEST_F(Interruption, NohupIsObeyed) {
  const Outcome outcome =
      shell(folder_,
            "trap '' HUP; $GRAMLOOM run c.toml --set size=300 --set 'seeds=[1,2,3,4]' & "
            "while ! test -e out/c/run.json; do sleep 0.01; done; "
            "echo before: $(grep -l '\"status\": \"done\"' out/c/*/*/seed*.json | wc -l) of 8; "
            "kill -HUP $!; wait $!");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, testing::ContainsRegex("before: [0-7] of 8"));
}

// As a service manager or a scheduler ends a run: its workers are told too, by both.
TEST_F(Interruption, ASignalToEveryProcessOfARunIsNoFailureOfItsJobs) {
  write_long_config();
  const Outcome outcome =
      shell(folder_,
            "$GRAMLOOM run long.toml --jobs 2 --set 'seeds=[1,2]' --only 'e/long' & run=$!; "
            "while ! test -e out/long/e/long/seed2.json; do sleep 0.01; done; sleep 0.2; "
            "kill -TERM $(cat /proc/$run/task/*/children) $run; wait $run");
  EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
  for (const std::string job : {"e/long/seed1", "e/long/seed2"})
    EXPECT_EQ(record(job, "out/long")->status, Status::interrupted) << job;
}

TEST_F(Interruption, AKilledJobIsNotCalledDone) {
  write_long_config();
  Process process(folder_, {"run", "long.toml"});
  wait_for_file("out/long/e/long/seed1.json");
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().exit_code, 128 + SIGKILL);
  EXPECT_EQ(record("e/long/seed1", "out/long")->status, Status::interrupted);
}

TEST_F(Interruption, KilledAtAnyMomentAndResumedNothingIsLost) {
  const std::vector<std::string> many{"--set", "seeds=[1,2,3,4,5]", "--set", "size=[200,150]"};
  const auto arguments = [&](std::vector<std::string> words) {
    words.insert(words.end(), many.begin(), many.end());
    return words;
  };
  ASSERT_EQ(run(arguments({"run", "c.toml", "--output", "whole"})).exit_code, 0);

  Random random(1);
  int kills = 0;
  for (; kills < 8; ++kills) {
    const auto before = finished_pictures("killed");
    const auto delay = std::chrono::milliseconds(20 + random.below(300));
    SCOPED_TRACE(fmt::format("kill {} after {} ms", kills, delay.count()));
    Process process(folder_, arguments({"run", "c.toml", "--output", "killed", "--resume"}));
    std::this_thread::sleep_for(delay);
    process.signal(SIGKILL);
    const bool finished = process.wait().exit_code == 0;
    const auto after = finished_pictures("killed");
    for (const auto& [picture, time] : before) {
      ASSERT_TRUE(after.contains(picture)) << picture << " is lost";
      ASSERT_EQ(after.at(picture), time) << picture << " was done again";
    }
    if (finished) break;
  }
  EXPECT_GT(kills, 1) << "the run is too short for this test";

  ASSERT_EQ(run(arguments({"run", "c.toml", "--output", "killed", "--resume"})).exit_code, 0);
  const auto whole = finished_pictures("whole");
  const auto textures = std::count_if(whole.begin(), whole.end(), [](const auto& picture) {
    return picture.first.filename().string().find('_') == std::string::npos;  // a map has one
  });
  EXPECT_EQ(textures, 10);
  for (const auto& [picture, time] : whole)
    EXPECT_EQ(read_text(picture),
              read_text(folder_ / "killed" / fs::relative(picture, folder_ / "whole")));
  for (int seed = 1; seed <= 5; ++seed) {
    const auto scored = record(fmt::format("e/q/seed{}", seed), "killed");
    EXPECT_FALSE(scored->metrics.empty());
    EXPECT_EQ(scored->metrics, record(fmt::format("e/q/seed{}", seed), "whole")->metrics);
    EXPECT_EQ(file("killed/" + scored->copy_map), file("whole/" + scored->copy_map));
  }
  const Json diversity = Json::parse(file("whole/run.json"))["diversity"];
  EXPECT_EQ(diversity.size(), 1u);
  EXPECT_EQ(Json::parse(file("killed/run.json"))["diversity"], diversity);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "killed"))
    EXPECT_TRUE(entry.is_directory() || !entry.path().filename().string().ends_with(".tmp"))
        << entry.path() << " was left";
}

TEST_F(Interruption, ARunFromTheStartThatIsKilledWhileItReplacesFilesLeavesNoResultCalledDone) {
  // Maps are written for a while after the picture.
  write_text(folder_ / "maps.toml",
             "[[method]]\nname = 'n'\nkind = 'procedural'\ntexture = 'noise'\n"
             "[surface]\nheight = 'brightness'\n");
  const std::string picture = "out/maps/procedural/n/seed1.png";
  ASSERT_EQ(run({"run", "maps.toml", "--set", "size=40"}).exit_code, 0);
  const std::string before = file(picture);
  Process process(folder_, {"run", "maps.toml", "--set", "size=900"});
  for (int i = 0; i < 60000 && file(picture) == before; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait().exit_code, 128 + SIGKILL);
  ASSERT_FALSE(file(picture) == before);
  EXPECT_EQ(record("procedural/n/seed1", "out/maps")->status, Status::interrupted);
  EXPECT_EQ(run({"run", "maps.toml", "--set", "size=40", "--resume"}).exit_code, 0);
  EXPECT_TRUE(file(picture) == before);
}

TEST_F(Interruption, WhatAKilledProcessLeftOfAFinishedJobIsRemoved) {
  ASSERT_EQ(run({"run", "c.toml"}).exit_code, 0);
  const std::vector<std::string> left{"e/q/.seed1.json.41babc3f.22701.22.tmp", "e/q/seed1.lock",
                                      "page/e/q/.seed1.view.js.074bf231.8783.11.tmp"};
  write_text(folder_ / "out/c" / left[0], "{");
  write_text(folder_ / "out/c" / left[1], "held by gramloom, process 22701 on host\n");
  EXPECT_EQ(run({"run", "c.toml", "--resume"}).exit_code, 0);
  for (const auto& name : left) EXPECT_FALSE(fs::exists(folder_ / "out/c" / name)) << name;
}

TEST_F(Interruption, TheMachinesSpeedIsMeasuredAgainWhereItsFileIsOfTomorrow) {
  // It was written before someone set the clock back.
  const std::string check = "XDG_CACHE_HOME=$PWD/cache $GRAMLOOM check c.toml > said 2>&1; ";
  const Outcome outcome =
      shell(folder_, check + "touch -d '+1 year' cache/gramloom/speed.json; " + check +
                         "find cache -name speed.json -newermt '+1 day'");
  EXPECT_EQ(outcome.output, "");
  EXPECT_TRUE(fs::exists(folder_ / "cache/gramloom/speed.json"));
}

TEST_F(Interruption, StoppedWhileItScoresTheTextureIsKeptAndOnlyScoredLater) {
  write_text(folder_ / "large.toml",
             "size = [500, 500]\n"
             "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "[[method]]\nname = 'p'\nkind = 'phase'\n");
  for (const int signal : {SIGINT, SIGKILL}) {
    fs::remove_all(folder_ / "out");
    Process process(folder_, {"run", "large.toml"});
    for (int i = 0; i < 15000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const auto made = record("e/p/seed1", "out/large");
      if (made && made->status == Status::done) break;
    }
    process.signal(signal);
    const Outcome stopped = process.wait();
    EXPECT_EQ(stopped.exit_code, signal == SIGINT ? 130 : 128 + SIGKILL);
    if (signal == SIGINT) {
      EXPECT_NE(stopped.errors.find("not all textures are scored"), std::string::npos)
          << stopped.errors;
    }
    EXPECT_EQ(record("e/p/seed1", "out/large")->status, Status::done);
    EXPECT_TRUE(record("e/p/seed1", "out/large")->metrics.empty());
    const auto time = fs::last_write_time(folder_ / "out/large/e/p/seed1.png");

    EXPECT_EQ(run({"run", "large.toml", "--resume"}).exit_code, 0);
    EXPECT_FALSE(record("e/p/seed1", "out/large")->metrics.empty());
    EXPECT_EQ(fs::last_write_time(folder_ / "out/large/e/p/seed1.png"), time);
    EXPECT_NE(file("out/large/scores.csv").find("e,p,phase,1,done,"), std::string::npos);
  }
}

TEST_F(Interruption, ASecondRunIntoTheSameFolderIsRefused) {
  write_long_config();
  Process process(folder_, {"run", "long.toml", "--output", "out/c"});
  wait_for_file("out/c/e/long/seed1.json");
  const Outcome second = run({"run", "c.toml"});
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_TRUE(second.errors.starts_with("--output out/c: another run is writing there (process "))
      << second.errors;
  EXPECT_EQ(run({"run", "c.toml", "--output", "elsewhere"}).exit_code, 0);
  process.signal(SIGKILL);
  process.wait();
  EXPECT_EQ(run({"run", "c.toml"}).exit_code, 0) << "the lock ends with its process";
}

TEST_F(Interruption, ADiskThatIsFullFailsTheJobInOneLine) {
  // A limit on the length of files stands for a full disk: noise does not fit, the record does.
  const Outcome outcome =
      shell(folder_, "trap '' XFSZ; ulimit -f 64; $GRAMLOOM run c.toml --quiet --set size=400");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 5)
      << "four jobs and the page: " << outcome.errors;
  EXPECT_EQ(record("e/q/seed1")->status, Status::failed);
  EXPECT_FALSE(fs::exists(folder_ / "out/c/e/q/seed1.png"));
}

TEST_F(Interruption, AFileOfTheRunThatCannotBeWrittenIsNoSuccess) {
  // The limit lets the page through, but not an exemplar of a million random bytes.
  Image image(600, 600, 3);
  Random random(1);
  for (float& value : image.pixels) value = random.uniform();
  write_image(folder_ / "e.png", image, {});
  const Outcome outcome =
      shell(folder_, "ulimit -f 600; $GRAMLOOM run c.toml --quiet --set scores=false");
  EXPECT_EQ(outcome.exit_code, 1) << "the exemplar is not beside its results";
  EXPECT_THAT(outcome.errors, testing::HasSubstr("exemplar.png"));
  EXPECT_EQ(record("e/q/seed2")->status, Status::done);
}

// An iterative method keeps its state, so that a stopped job goes on where it was.
class Iterative : public Interruption {
 protected:
  static constexpr int iterations = 100;  // more than go by before a busy machine lets us look
  const std::string job_ = "e/gram/seed1";

  Iterative() {
    write_text(folder_ / "gram.toml",
               fmt::format("size = [32, 32]\n"
                           "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
                           "[[method]]\nname = 'gram'\nkind = 'neural'\npreset = 'gatys'\n"
                           "network = 'vgg_small'\n"
                           "iterations = {}\n",
                           iterations));
  }

  Trace trace(const std::string& out) const { return parse_trace(file(out + "/" + job_ + ".csv")); }
  // Starts a run and sends a signal when it has made some steps.
  Outcome stop_in_the_middle(int signal, const std::vector<std::string>& arguments) const {
    Process process(folder_, arguments);
    const fs::path rows = folder_ / "out/gram" / (job_ + ".checkpoint.csv");
    for (int i = 0; i < 30000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (fs::exists(rows) && parse_trace(read_text(rows)).rows.size() >= 5) break;
    }
    process.signal(signal);
    return process.wait();
  }
  void expect_whole_trace(const std::string& out) const {
    const Trace found = trace(out);
    ASSERT_EQ(found.rows.size(), static_cast<std::size_t>(iterations));
    for (int i = 0; i < iterations; ++i) {
      const auto row = static_cast<std::size_t>(i);
      EXPECT_EQ(found.rows[row].step, i + 1);
      if (i == 0) continue;
      EXPECT_GE(found.rows[row].seconds, found.rows[row - 1].seconds);
      EXPECT_GT(found.rows[row].evaluations, found.rows[row - 1].evaluations);
    }
  }
  bool unfinished_state() const {
    return fs::exists(folder_ / "out/gram" / (job_ + ".checkpoint")) ||
           fs::exists(folder_ / "out/gram" / (job_ + ".checkpoint.csv"));
  }
};

TEST_F(Iterative, TheEndOfTheTerminalSavesWhatThereIsAndResumeGoesOnToTheSameResult) {
  ASSERT_EQ(run({"run", "gram.toml", "--output", "whole"}).exit_code, 0);
  expect_whole_trace("whole");

  EXPECT_EQ(stop_in_the_middle(SIGHUP, {"run", "gram.toml"}).exit_code, 130);
  EXPECT_EQ(record(job_, "out/gram")->status, Status::interrupted);
  EXPECT_NO_THROW(read_image(folder_ / "out/gram" / (job_ + ".png")));
  const Trace before = trace("out/gram");
  EXPECT_GE(before.rows.size(), 5u);
  EXPECT_TRUE(unfinished_state());

  EXPECT_EQ(run({"run", "gram.toml", "--resume"}).exit_code, 0);
  expect_whole_trace("out/gram");
  const Trace after = trace("out/gram");
  EXPECT_TRUE(std::equal(before.rows.begin(), before.rows.end() - 1, after.rows.begin()))
      << "steps before the stop were done again";
  EXPECT_FALSE(unfinished_state());
  const auto result = record(job_, "out/gram");
  EXPECT_EQ(result->loss->iterations, iterations);
  EXPECT_EQ(result->loss->last, after.rows.back().loss);
  EXPECT_EQ(file("out/gram/" + job_ + ".png"), file("whole/" + job_ + ".png"));
}

TEST_F(Iterative, KilledAndResumed) {
  EXPECT_EQ(stop_in_the_middle(SIGKILL, {"run", "gram.toml"}).exit_code, 128 + SIGKILL);
  EXPECT_EQ(record(job_, "out/gram")->status, Status::interrupted);
  EXPECT_EQ(run({"run", "gram.toml", "--resume"}).exit_code, 0);
  expect_whole_trace("out/gram");
  EXPECT_FALSE(unfinished_state());
}

TEST_F(Iterative, WithoutResumeOrWithOtherSettingsItBeginsAnew) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "gram.toml"},
        std::vector<std::string>{"run", "gram.toml", "--resume", "--set", "layer_weights=[]",
                                 "--set", "history=7"}}) {
    stop_in_the_middle(SIGINT, {"run", "gram.toml"});
    const double seconds = trace("out/gram").rows.front().seconds;
    EXPECT_EQ(run(arguments).exit_code, 0);
    expect_whole_trace("out/gram");
    EXPECT_NE(trace("out/gram").rows.front().seconds, seconds);
    fs::remove_all(folder_ / "out");
  }
}

}  // namespace
}  // namespace gramloom
