#include "jobs/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <initializer_list>
#include <string_view>

namespace gramloom {

namespace {

constexpr unsigned seconds_to_stop = 2;
constexpr int exit_code = 130;

std::atomic<bool> asked{false};
std::atomic<int> scopes{0};  // of NothingToKeep

// In these handlers only what POSIX calls safe in one.
extern "C" void stop_waiting(int) {
  if (scopes == 0) {
    alarm(1);
    return;
  }
  constexpr std::string_view line = "\ngramloom: interrupted; --resume goes on\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
  _exit(exit_code);
}

extern "C" void ask_to_stop(int number) {
  if (!asked.exchange(true)) {
    alarm(seconds_to_stop);
  } else if (number != SIGHUP) {
    signal(number, SIG_DFL);
    raise(number);
  }
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(number, &action, nullptr);
}

bool is_ignored(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void watch_signals() {
  handle(SIGALRM, stop_waiting);
  for (const int number : {SIGINT, SIGTERM}) handle(number, ask_to_stop);
  if (!is_ignored(SIGHUP)) handle(SIGHUP, ask_to_stop);
}

bool stop_asked() { return asked; }

NothingToKeep::NothingToKeep() { ++scopes; }
NothingToKeep::~NothingToKeep() { --scopes; }

}  // namespace gramloom
