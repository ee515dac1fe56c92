// Runs of several processes.
#include <signal.h>
#include <sys/file.h>

#include <chrono>
#include <fstream>
#include <list>
#include <map>
#include <thread>

#include "cli/workspace.h"
#include "runs/csv.h"
#include "runs/file_lock.h"

namespace gramloom {
namespace {

namespace fs = std::filesystem;

class Spread : public Workspace {
 protected:
  // All that a run leaves but what tells of time, memory and processes.
  std::map<std::string, std::string> results(const fs::path& out) const {
    std::map<std::string, std::string> results;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / out)) {
      const std::string name = entry.path().lexically_relative(folder_ / out).string();
      if (entry.path().extension() == ".png") results[name] = read_text(entry.path());
      if (entry.path().filename() == "diversity.json") results[name] = read_text(entry.path());
      EXPECT_NE(entry.path().extension(), ".lock") << name;
      EXPECT_NE(entry.path().extension(), ".tmp") << name;
    }
    for (CsvRow row : parse_csv(read_text(folder_ / out / "scores.csv"))) {
      const std::string job = fmt::format("{}/{}/{}", row.at(0), row.at(1), row.at(3));
      row.at(5) = row.at(6) = "";  // seconds and memory
      results[job] = csv_line(row);
    }
    return results;
  }

  static void wait_for(const auto& condition) {
    for (int i = 0; i < 6000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(condition());
  }

  void write_long_config() const {
    write_text(folder_ / "long.toml",
               "size = [400, 400]\nscores = false\n"
               "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
               "[[method]]\nname = 'long'\nkind = 'patchmatch'\niterations = 1000\n"
               "[[method]]\nname = 'next'\nkind = 'quilting'\npatch_size = 8\n");
  }

  // The process that holds a job's lock.
  pid_t worker_of(const std::string& job) const {
    const std::string holder = holder_of(folder_ / (job + ".lock"));
    int process = 0;
    return std::sscanf(holder.c_str(), "process %d", &process) == 1 ? process : 0;
  }
};

TEST_F(Spread, JobsSideBySideAreTheSameAsOneAfterAnother) {
  ASSERT_EQ(run({"run", "c.toml", "--output", "one"}).exit_code, 0);
  const Outcome outcome = run({"run", "c.toml", "--output", "two", "--jobs", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(results("one"), results("two"));
  EXPECT_TRUE(fs::exists(folder_ / "two/index.html"));
  const Outcome again = run({"run", "c.toml", "--output", "two", "--jobs", "3", "--resume"});
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.errors.find("e/q/seed1: finished before"), std::string::npos) << again.errors;
  EXPECT_EQ(results("one"), results("two"));
}

TEST_F(Spread, ShardsTogetherAreTheWholeRun) {
  ASSERT_EQ(run({"run", "c.toml", "--output", "one"}).exit_code, 0);
  std::list<Process> shards;
  for (int i = 1; i <= 3; ++i)
    shards.emplace_back(folder_, std::vector<std::string>{"run", "c.toml", "--output", "all",
                                                          "--shard", fmt::format("{}/3", i)});
  for (Process& shard : shards) {
    const Outcome outcome = shard.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("gramloom report all makes the page"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder_ / "all/index.html"));
  EXPECT_FALSE(fs::exists(folder_ / "run.json")) << "nothing is written beside the folder";
  EXPECT_FALSE(fs::exists(folder_ / "scores.csv"));
  EXPECT_EQ(run({"report", "all"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "all/index.html"));
  EXPECT_EQ(results("one"), results("all"));
}

TEST_F(Spread, ATaskOfASlurmArrayDoesItsPart) {
  const Outcome outcome = shell(folder_,
                                "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=6 "
                                "SLURM_ARRAY_TASK_COUNT=2 $GRAMLOOM run c.toml --shard");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find(": done in"), std::string::npos) << outcome.errors;
  const std::string sheet = file("out/c/scores.csv");
  EXPECT_NE(sheet.find("waiting"), std::string::npos) << sheet;
  const Outcome elsewhere = run({"run", "c.toml", "--shard"});
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_TRUE(is_one_line(elsewhere.errors)) << elsewhere.errors;
}

TEST_F(Spread, AWorkerThatDiesFailsItsJobAlone) {
  write_long_config();
  Process process(folder_, {"run", "long.toml", "--output", "out", "--jobs", "2"});
  wait_for([&] { return worker_of("out/e/long/seed1") > 0 && record("e/next/seed1", "out"); });
  kill(worker_of("out/e/long/seed1"), SIGKILL);
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_EQ(record("e/long/seed1", "out")->status, Status::failed);
  EXPECT_EQ(record("e/long/seed1", "out")->error, "its process was killed by signal 9");
  EXPECT_EQ(record("e/next/seed1", "out")->status, Status::done);
}

TEST_F(Spread, CtrlCStopsAllProcessesAndResumeGoesOn) {
  write_long_config();
  {
    Process process(folder_, {"run", "long.toml", "--output", "out", "--jobs", "2"});
    wait_for([&] { return worker_of("out/e/long/seed1") > 0; });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const pid_t worker = worker_of("out/e/long/seed1");
    process.signal(SIGINT);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 130) << outcome.errors;
    EXPECT_EQ(kill(worker, 0), -1) << "the worker has ended";
  }
  EXPECT_EQ(record("e/long/seed1", "out")->status, Status::interrupted);
  // Whoever is killed takes the workers along.
  Process process(folder_, {"run", "long.toml", "--output", "out", "--jobs", "2", "--resume"});
  wait_for([&] { return worker_of("out/e/long/seed1") > 0; });
  const pid_t worker = worker_of("out/e/long/seed1");
  process.signal(SIGKILL);
  process.wait();
  wait_for([&] { return kill(worker, 0) == -1; });
}

TEST_F(Spread, AJobThatAnotherProcessHasIsDoneAtTheEndIfThatOneDies) {
  fs::create_directories(folder_ / "out/c/e/q");
  auto lock = FileLock::take(folder_ / "out/c/e/q/seed1.lock", FileLock::Mode::exclusive);
  Process process(folder_, {"run", "c.toml", "--shard", "1/1"});
  wait_for([&] { return record("e/q/seed2") && record("e/q/seed2")->status == Status::done; });
  EXPECT_FALSE(record("e/q/seed1"));
  lock.reset();  // as a process that was killed
  const Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(record("e/q/seed1")->status, Status::done);
  EXPECT_TRUE(fs::exists(folder_ / "out/c/e/q/diversity.json"));
  EXPECT_NE(outcome.errors.find(fmt::format("e/q/seed1: is done by process {} on ", getpid())),
            std::string::npos)
      << outcome.errors;
}

TEST_F(Spread, WhatDoesNotGoTogetherIsRefused) {
  write_long_config();
  const auto refused = [&](std::vector<std::string> arguments, const std::string& error) {
    const Outcome outcome = run(std::move(arguments));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(outcome.errors.starts_with(error)) << outcome.errors;
    EXPECT_TRUE(is_one_line(outcome.errors)) << outcome.errors;
  };
  refused({"run", "c.toml", "--shard", "3/2"}, "--shard: '3/2' is no shard: ");
  refused({"run", "c.toml", "--shard", "1/2", "--baseline", "out/c"},
          "--baseline compares a whole");
  refused({"run", "c.toml", "--jobs", "-1"}, "--jobs");
  Process process(folder_, {"run", "long.toml", "--output", "out", "--shard", "1/1"});
  wait_for([&] { return worker_of("out/e/long/seed1") > 0; });
  refused({"run", "long.toml", "--output", "out"}, "--output out: another run is writing there");
  refused({"run", "c.toml", "--output", "out", "--shard", "1/2"},
          "--output out: another config, or with other --set, is run there by others: long.toml");
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait().exit_code, 130);
}

}  // namespace
}  // namespace gramloom
