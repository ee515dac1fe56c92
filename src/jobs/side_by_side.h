#pragma once

#include "jobs/run_state.h"

namespace gramloom {

/// Does the plan's selected jobs, options.jobs of them at once, each in a process of its own
/// (worker.h), with its part of the threads and as far as their memory, by the estimates, fits
/// together. A process that dies fails its job alone.
void do_side_by_side(RunState& state);

}  // namespace gramloom
