#pragma once

#include <chrono>

namespace gramloom {

/// From now on the first Ctrl-C (SIGINT), SIGTERM or end of the terminal (SIGHUP) asks the work to
/// stop. The next one ends the process at once, whatever it is doing; but not a further SIGHUP,
/// which shells send more than once. One who asked that SIGHUP be ignored (nohup) is obeyed. To be
/// called once, before any other thread is started: those that were would not be spared the
/// signals. For the patience see NothingToKeep.
void watch_signals(std::chrono::milliseconds patience = std::chrono::seconds(2));

/// Whether the user has asked the work to stop.
bool stop_asked();

/// While one of these lives, all that is worth keeping is on disk. Work that is asked to stop then,
/// and does not within our patience because a library is busy, is not waited for: the process ends
/// with exit code 130.
class NothingToKeep {
 public:
  NothingToKeep();
  ~NothingToKeep();
  NothingToKeep(const NothingToKeep&) = delete;
  NothingToKeep& operator=(const NothingToKeep&) = delete;
};

}  // namespace gramloom
