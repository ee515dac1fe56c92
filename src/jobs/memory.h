#pragma once

#include "jobs/methods.h"

namespace gramloom {

/// Bytes that the process may still take: of the machine, and of its control group when that is
/// less.
double available_memory();

/// What the program and its libraries hold while they do a job of this kind, beside the work.
double program_memory(const Method& method);

/// The most bytes that the process has held since the last reset (where the kernel lets a process
/// reset it, otherwise since its start).
double peak_memory();
void reset_peak_memory();

}  // namespace gramloom
