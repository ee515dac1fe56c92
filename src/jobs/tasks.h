#pragma once

#include <cstddef>
#include <optional>

#include "jobs/job_scores.h"
#include "jobs/run_job.h"

namespace gramloom {

/// What one process does at a time for a run.
enum class TaskKind { texture, scores, diversity };
template <>
inline constexpr auto enum_names<TaskKind> = std::to_array<std::string_view>({"texture", "scores",
                                                                              "diversity"});

struct Task {
  TaskKind kind = TaskKind::texture;
  int job = 0;         // its number in the plan; of a diversity, of one of its jobs
  bool waits = false;  // for a process that has the job, which may finish it or die

  static constexpr auto fields() {
    using T = Task;
    return std::tuple{
        Field{"kind", &T::kind, "what is to be done"},
        Field{"job", &T::job, "the job's number in the plan", "", {0, 1e9}},
        Field{"waits", &T::waits, "for another process that has the job"},
    };
  }
};

/// What came of it. It is on disk, too, as far as that could be written.
struct TaskResult {
  std::optional<JobRecord> record;         // of a texture or its scores
  std::optional<SeedDiversity> diversity;  // none: there are no two finished textures
  bool stopped = false;                    // the user did, and nothing is kept
  std::string elsewhere;  // who does the job at this time, and so it is not done here
  std::string error;      // why there is no diversity

  static constexpr auto fields() {
    using T = TaskResult;
    return std::tuple{
        Field{"record", &T::record, "of the job"},
        Field{"diversity", &T::diversity, "of a method's seeds"},
        Field{"stopped", &T::stopped, "whether the user stopped it"},
        Field{"elsewhere", &T::elsewhere, "who does the job"},
        Field{"error", &T::error, "why there is no diversity"},
    };
  }
};

/// Does it; what goes wrong is in the result.
TaskResult do_task(Run& run, const Task& task);

/// The jobs of each exemplar and method, as they follow each other in the plan.
std::vector<JobGroup> groups_of(const Plan& plan);
/// That of the job of this number.
JobGroup group_of(const Plan& plan, int job);

/// A job's number in its plan, and the job of a task.
int number_of(const Plan& plan, const PlannedJob& planned);
const PlannedJob& job_of(const Plan& plan, const Task& task);

}  // namespace gramloom
