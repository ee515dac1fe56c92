// Fewer threads than asked for: by OpenMP's own limits, by affinity, and where the system refuses.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

#include "cli/workspace.h"

namespace gramloom {
namespace {

class FewThreads : public Workspace {
 protected:
  FewThreads() {
    write_text(folder_ / "n.toml",
               "size = 64\nscores = false\n"
               "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
               "[[method]]\nname = 'n'\nkind = 'neural'\npreset = 'fast'\niterations = [4]\n"
               "[[method]]\nname = 'g'\nkind = 'neural'\npreset = 'gatys'\n"
               "network = 'vgg_small'\niterations = [4]\n"
               "[[method]]\nname = 'q'\nkind = 'quilting'\n");
  }

  // Runs the config under a prefix of its command line; no run of it takes as long as the limit.
  Outcome run_with(const std::string& prefix, const std::string& arguments = "") const {
    return shell(folder_,
                 prefix + " timeout -k 5 60 \"$GRAMLOOM\" run n.toml --quiet " + arguments);
  }
  std::string threads_of_run() const {
    return Json::parse(file("out/n/run.json"))["machine"]["threads"].dump();
  }
};

TEST_F(FewThreads, OpenMPsLimitIsKept) {
  for (const std::string arguments : {"", "--threads 4"}) {
    const Outcome one = run_with("OMP_THREAD_LIMIT=1", arguments);
    EXPECT_EQ(one.exit_code, 0) << one.errors;
    EXPECT_EQ(threads_of_run(), "1");
  }
  const Outcome two = run_with("OMP_THREAD_LIMIT=2", "--threads 4");
  EXPECT_EQ(two.exit_code, 0) << two.errors;
  EXPECT_EQ(threads_of_run(), "2");
}

TEST_F(FewThreads, OtherSettingsOfOpenMPDoNotStopTheWork) {
  for (const std::string setting :
       {"OMP_DYNAMIC=true", "OMP_MAX_ACTIVE_LEVELS=0", "OMP_NUM_THREADS=1", "OMP_PROC_BIND=true",
        "OMP_WAIT_POLICY=passive", "OMP_NUM_THREADS=64", "OMP_THREAD_LIMIT=nonsense"}) {
    const Outcome outcome = run_with(setting, "--threads 4");
    EXPECT_EQ(outcome.exit_code, 0) << setting << ": " << outcome.errors;
  }
}

TEST_F(FewThreads, AffinityIsCounted) {
  const Outcome outcome = run_with("taskset -c 0");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(threads_of_run(), "1");
}

TEST_F(FewThreads, NoLibraryComplainsOfMoreThreadsThanCores) {
  const Outcome outcome =
      shell(folder_, "\"$GRAMLOOM\" run n.toml --quiet --only e/q --threads $(( $(nproc) * 8 ))");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(FewThreads, ThreadsThatTheSystemRefusesAreDoneWithout) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs the address space";
#endif
  // Each thread has a stack of its own: 200 of 64 MB do not fit, nor 16 of LibTorch's, of OpenMP's
  // and of our own.
  for (const auto& [job, most] : {std::pair("e/q", 200), std::pair("e/n", 16)}) {
    const Outcome outcome =
        shell(folder_, fmt::format("ulimit -s 65536; ulimit -v 6000000;"
                                   "timeout -k 5 100 \"$GRAMLOOM\" run n.toml --quiet --only {} "
                                   "--threads $(( $(nproc) * 8 < {} ? $(nproc) * 8 : {} ))",
                                   job, most, most));
    EXPECT_EQ(outcome.exit_code, 0) << job << ": " << outcome.errors;
  }
}

TEST_F(FewThreads, TooLittleAddressSpaceFailsTheJobInOneLine) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs the address space";
#endif
  const Outcome outcome =
      shell(folder_,
            "ulimit -v 1500000;"
            "timeout -k 5 100 \"$GRAMLOOM\" run n.toml --quiet --only e/n --set size=2048");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors, testing::StartsWith("e/n/seed1: failed: "));
  EXPECT_THAT(outcome.errors, testing::HasSubstr("memory"));
  EXPECT_THAT(outcome.errors, testing::Not(testing::HasSubstr("enforce")));
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1);
  EXPECT_EQ(record("e/n/seed1", "out/n")->status, Status::failed);
}

TEST_F(FewThreads, CtrlCIsHeard) {
  write_text(folder_ / "long.toml",
             "size = 256\nscores = false\n"
             "[[exemplar]]\nname = 'e'\nimage = 'e.png'\n"
             "[[method]]\nname = 'n'\nkind = 'neural'\npreset = 'fast'\niterations = [100000]\n");
  setenv("OMP_THREAD_LIMIT", "1", 1);
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(folder_ / "out");
    Process process(folder_, {"run", "long.toml", "--quiet"});
    for (int i = 0; i < 3000 && !record("e/n/seed1", "out/long"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.signal(signal);
    EXPECT_EQ(process.wait().exit_code, 130);
  }
  unsetenv("OMP_THREAD_LIMIT");
}

}  // namespace
}  // namespace gramloom
