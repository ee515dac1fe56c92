#pragma once

#include <vector>

#include "jobs/run_job.h"

namespace gramloom {

/// Whether the job's record is of a finished texture that its config asks to score, and that has no
/// scores.
bool lacks_scores(const Run& run, const PlannedJob& planned, const JobRecord& record);

/// Scores the job's texture as it stands on disk, writes the copy map and then the record with the
/// scores; a scoring that fails is in the record, as `score_error`. False when the user has stopped
/// it: then nothing is written.
bool score_job(Run& run, const PlannedJob& planned, JobRecord& record);

/// The jobs of one exemplar and method, a seed each.
using JobGroup = std::vector<const PlannedJob*>;

/// Those that are finished, as their records say.
std::vector<NamedRecord> finished_jobs(const Run& run, const JobGroup& jobs);

/// How unlike the textures of these finished jobs, of the exemplar of `job`, are: see metrics'
/// diversity(). Throws Error for fewer than two, Interrupted when the user stops it.
double diversity_of(Run& run, const Job& job, const std::vector<NamedRecord>& jobs);

}  // namespace gramloom
