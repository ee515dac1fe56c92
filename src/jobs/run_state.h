#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "jobs/run_log.h"
#include "jobs/runner.h"
#include "jobs/tasks.h"

namespace gramloom {

/// A run while it goes on: what it works with, what it has written of it, what it will return.
struct RunState {
  Run& run;
  RunLog& log;
  RunSummary& summary;
  std::set<std::string> noted = {};                // of notes in records, those that were told
  std::set<std::size_t> made = {};                 // exemplars of which there is a texture
  std::map<std::size_t, std::string> unkept = {};  // those that could not be kept, and why
};

/// The record of a job that --resume finds finished, and what an unfinished attempt left of it is
/// removed; says why when there is a record, but not of that.
std::optional<JobRecord> finished_before(RunState& state, const PlannedJob& planned);

/// Counts and says what came of a texture, and puts it down.
void settle_texture(RunState& state, const PlannedJob& planned, const TaskResult& result);
void settle_finished_before(RunState& state, const PlannedJob& planned, const JobRecord& record);
void settle_scores(RunState& state, const PlannedJob& planned, const TaskResult& result);
void settle_diversity(RunState& state, const JobGroup& group, const TaskResult& result);

/// Whether the seeds of a group are to be compared, now that no more of its textures will be made
/// here. What a comparison that was killed has left is removed.
bool wants_diversity(RunState& state, const JobGroup& group);

/// Puts the exemplar of a job beside its results, so that the folder tells the whole story wherever
/// it goes; once for jobs of one exemplar that follow each other: `kept`.
void keep_exemplar(RunState& state, const Job& job, std::optional<std::size_t>& kept);

/// Says which exemplars of textures that were made are not there: the folder lacks them.
void tell_unkept(RunState& state);

/// Writing the run's own files may fail without harm to the jobs; whether it did not.
bool or_complain(const Run& run, const std::function<void()>& write);

}  // namespace gramloom
