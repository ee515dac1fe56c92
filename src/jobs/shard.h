#pragma once

#include <string>

#include "jobs/plan.h"

namespace gramloom {

/// One of the parts into which the jobs of a run are divided, each for a process of its own,
/// counted from 1.
struct Shard {
  int index = 1;
  int count = 1;
};

/// "3/16". Throws Error.
Shard parse_shard(const std::string& text);

/// That of a task of a Slurm array, by SLURM_ARRAY_TASK_ID, _MIN, _STEP and _COUNT. Throws Error
/// where they are missing.
Shard shard_of_slurm();

/// Leaves only the shard's part of the plan's selected jobs selected. All shards together have
/// each job once. Each in turn, the dearest first, goes to the shard that has least to do (Graham,
/// "Bounds on multiprocessing timing anomalies", 1969): none has over 4/3 of what the best division
/// would give the busiest.
void select_shard(Plan& plan, const Shard& shard);

/// How long a job is expected to take, with all that is made of its texture.
double seconds_of(const PlannedJob& job);

}  // namespace gramloom
