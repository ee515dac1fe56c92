#include "jobs/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <thread>

namespace gramloom {

namespace {

constexpr int exit_code = 130;

std::atomic<bool> asked{false};
std::atomic<int> scopes{0};  // of NothingToKeep

bool is_ignored(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

[[noreturn]] void end_without_waiting() {
  constexpr std::string_view line = "\ngramloom: interrupted; --resume goes on\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  _exit(exit_code);
}

[[noreturn]] void end_by(int number) {
  signal(number, SIG_DFL);
  sigset_t alone;
  sigemptyset(&alone);
  sigaddset(&alone, number);
  pthread_sigmask(SIG_UNBLOCK, &alone, nullptr);
  raise(number);
  _exit(128 + number);
}

// What a thread of its own does.
void listen(sigset_t signals, std::chrono::milliseconds patience) {
  const timespec pause{patience.count() / 1000, patience.count() % 1000 * 1'000'000};
  int number = 0;
  sigwait(&signals, &number);
  asked = true;
  for (;;) {
    number = sigtimedwait(&signals, nullptr, &pause);
    if (number == SIGINT || number == SIGTERM) end_by(number);
    if (number < 0 && errno == EAGAIN && scopes > 0) end_without_waiting();
  }
}

}  // namespace

// A handler would run in whichever thread the signal finds, on that thread's stack. But oneDNN's
// matrix products keep another pointer in the stack pointer's register, and what a handler pushes
// there would fall into their numbers, or anywhere on the heap. So no thread of ours is disturbed,
// and one that does nothing else waits for signals.
void watch_signals(std::chrono::milliseconds patience) {
  sigset_t signals, before;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM}) sigaddset(&signals, number);
  if (!is_ignored(SIGHUP)) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, &before);  // also of the threads that this one starts
  try {
    std::thread(listen, signals, patience).detach();
  } catch (const std::system_error&) {  // no more threads: a signal ends the process, as ever
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
}

bool stop_asked() { return asked; }

NothingToKeep::NothingToKeep() { ++scopes; }
NothingToKeep::~NothingToKeep() { --scopes; }

}  // namespace gramloom
