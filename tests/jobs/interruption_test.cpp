#include "jobs/interruption.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace gramloom {
namespace {

constexpr std::chrono::milliseconds short_patience{200};

// A library that does not look up.
[[noreturn]] void work_for_ever() {
  for (;;) pause();
}

// To the process, as a terminal sends it; the first is heard before this returns.
void send(int number) {
  kill(getpid(), number);
  while (!stop_asked()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(SignalsDeathTest, TheFirstAsksAndTheNextEndsTheProcess) {
  EXPECT_EXIT(
      {
        watch_signals();
        const bool asked_before = stop_asked();
        send(SIGINT);
        std::_Exit(!asked_before && stop_asked() ? 3 : 4);
      },
      testing::ExitedWithCode(3), "");
  for (const int second : {SIGINT, SIGTERM})
    EXPECT_EXIT(
        {
          watch_signals();
          send(SIGHUP);
          send(second);
          work_for_ever();
        },
        testing::KilledBySignal(second), "");
}

TEST(SignalsDeathTest, ATerminalMayEndTwice) {
  EXPECT_EXIT(
      {
        watch_signals();
        send(SIGHUP);
        send(SIGHUP);
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        std::_Exit(stop_asked() ? 3 : 4);
      },
      testing::ExitedWithCode(3), "");
}

TEST(SignalsDeathTest, WorkWithNothingToKeepIsNotWaitedFor) {
  EXPECT_EXIT(
      {
        watch_signals(short_patience);
        const NothingToKeep scope;
        send(SIGINT);
        work_for_ever();
      },
      testing::ExitedWithCode(130), "interrupted; --resume goes on");
}

TEST(SignalsDeathTest, WorkWithSomethingToKeepIsWaitedFor) {
  EXPECT_EXIT(
      {
        watch_signals(short_patience);
        { const NothingToKeep scope; }
        send(SIGINT);
        std::this_thread::sleep_for(3 * short_patience);
        std::_Exit(3);
      },
      testing::ExitedWithCode(3), "");
}

// Libraries use the register of the stack pointer for other ends: whatever is pushed there while
// they work is written into their numbers.
TEST(SignalsDeathTest, NoHandlerRunsInAThreadThatWorks) {
  EXPECT_EXIT(
      {
        watch_signals();
        bool spared = true;
        const auto look = [&] {
          sigset_t blocked;
          pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
          for (const int number : {SIGINT, SIGTERM, SIGHUP})
            spared = spared && sigismember(&blocked, number) == 1;
        };
        look();
        std::thread(look).join();
        for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) {
          struct sigaction action {};
          sigaction(number, nullptr, &action);
          spared = spared && action.sa_handler == SIG_DFL;
        }
        std::_Exit(spared ? 3 : 4);
      },
      testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace gramloom
