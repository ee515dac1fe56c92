#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/worker.h"

namespace gramloom {

/// A worker from its parent's side.
class WorkerProcess {
 public:
  /// Starts `program`, which is gramloom, or empty for this one, with these words of a run and what
  /// makes it a worker of so many threads. Throws Error.
  WorkerProcess(const std::filesystem::path& program, const std::vector<std::string>& words,
                int threads, const std::string& greeting);
  /// Ends it.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// False: it cannot be asked.
  bool ask(const Task& task);
  /// To be polled for answers.
  int descriptor() const { return answers_; }
  /// Those that have come; none once it has ended.
  std::optional<std::vector<WorkerAnswer>> answers();
  /// Asks it to stop as Ctrl-C would.
  void stop();
  bool has_ended();
  /// Ends it, if need be by force: "was killed by signal 9", "ended with code 1".
  std::string how_it_ended();

 private:
  pid_t process_ = -1;
  int status_ = 0;  // once it has ended
  int tasks_ = -1, answers_ = -1;
  std::string rest_;  // of a line
};

}  // namespace gramloom
