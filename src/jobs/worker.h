#pragma once

#include <string>
#include <vector>

#include "jobs/runner.h"
#include "jobs/tasks.h"

namespace gramloom {

// A process that does tasks of a run for another one, which is its parent: that has begun it with
// the same command line and --worker, and asks it by a line each on its standard input: a Task as
// JSON. It answers on the descriptor `worker_answers` by lines of WorkerAnswer, of which the last
// for a task has its result.

inline constexpr int worker_answers = 3;

struct WorkerAnswer {
  double part = 0;  // of the task that is done
  std::optional<TaskResult> result;

  static constexpr auto fields() {
    using A = WorkerAnswer;
    return std::tuple{
        Field{"part", &A::part, "of the task that is done", "", {0, 1}},
        Field{"result", &A::result, "what came of it"},
    };
  }
};

/// What a parent says first, so that a config that has changed since it was read is noticed.
std::string worker_greeting(const Config& config);

/// The worker's work: returns when the parent has no more, or is gone. Throws Error.
void work_for_parent(const Config& config, const RunOptions& options);

}  // namespace gramloom
