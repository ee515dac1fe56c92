#include "jobs/interruption.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace gramloom {
namespace {

// A library that does not look up.
[[noreturn]] void work_for_ever() {
  for (;;) pause();
}

TEST(SignalsDeathTest, TheFirstAsksAndTheNextEndsTheProcess) {
  EXPECT_EXIT(
      {
        watch_signals();
        raise(SIGINT);
        std::_Exit(stop_asked() ? 3 : 4);
      },
      testing::ExitedWithCode(3), "");
  for (const int second : {SIGINT, SIGTERM})
    EXPECT_EXIT(
        {
          watch_signals();
          raise(SIGHUP);
          raise(second);
          work_for_ever();
        },
        testing::KilledBySignal(second), "");
}

TEST(SignalsDeathTest, ATerminalMayEndTwice) {
  EXPECT_EXIT(
      {
        watch_signals();
        raise(SIGHUP);
        raise(SIGHUP);
        std::_Exit(stop_asked() ? 3 : 4);
      },
      testing::ExitedWithCode(3), "");
}

TEST(SignalsDeathTest, WorkWithNothingToKeepIsNotWaitedFor) {
  EXPECT_EXIT(
      {
        watch_signals();
        const NothingToKeep scope;
        raise(SIGINT);
        work_for_ever();
      },
      testing::ExitedWithCode(130), "interrupted; --resume goes on");
}

TEST(SignalsDeathTest, WorkWithSomethingToKeepIsWaitedFor) {
  EXPECT_EXIT(
      {
        watch_signals();
        { const NothingToKeep scope; }
        raise(SIGINT);
        for (int wait = 5; wait > 0;) wait = static_cast<int>(sleep(static_cast<unsigned>(wait)));
        std::_Exit(3);
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace gramloom
