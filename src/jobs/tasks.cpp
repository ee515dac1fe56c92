#include "jobs/tasks.h"

#include <thread>

#include "core/polling.h"
#include "io/text_file.h"
#include "jobs/interruption.h"
#include "runs/file_lock.h"
#include "runs/format.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

bool same_group(const PlannedJob& a, const PlannedJob& b) {
  return a.job.exemplar == b.job.exemplar && a.job.method == b.job.method;
}

// Throws Error where nothing can be written or locked.
std::optional<FileLock> lock_job(const Run& run, const JobFiles& files, bool waits) {
  create_folder(files.folder);
  for (;;) {
    auto lock = FileLock::take(files.lock, FileLock::Mode::exclusive);
    if (lock || !waits || run.stopped()) return lock;
    std::this_thread::sleep_for(polling_pause);
  }
}

// Does the work with the job's lock. Where none can be had because of the file system, the work
// says what is wrong, if anything is.
template <class F>
void with_lock(Run& run, const PlannedJob& planned, bool waits, TaskResult& result, F&& work) {
  const JobFiles files = job_files(run.options.output, planned.name);
  std::optional<FileLock> lock;
  try {
    lock = lock_job(run, files, waits);
    if (!lock) {
      const std::string holder = holder_of(files.lock);
      result.stopped = waits;
      if (!waits) result.elsewhere = holder.empty() ? "another process" : holder;
      return;
    }
  } catch (const Error& error) {
    if (run.options.shard) {  // without a lock two could do it
      result.record = fail_job(run, planned, false, error.what());
      return;
    }
  }
  remove_stale_temporaries(files);  // of one that was killed at this job
  work();
}

void make_texture(Run& run, const PlannedJob& planned, bool waited, TaskResult& result) {
  // Another process may have finished it since someone looked.
  const bool may_be_done = waited || (run.options.shard && run.options.resume);
  if (may_be_done && reason_to_run(run, planned).empty())
    result.record = find_record(job_files(run.options.output, planned.name).record);
  if (!result.record) result.record = run_job(run, planned);
}

void score(Run& run, const PlannedJob& planned, TaskResult& result) {
  try {
    result.record = read_record(job_files(run.options.output, planned.name).record);
  } catch (const Error& error) {
    result.error = first_line(error.what());
  }
  if (result.record && lacks_scores(run, planned, *result.record))
    result.stopped = !score_job(run, planned, *result.record);
}

// How unlike the finished textures of a group are.
void compare_seeds(Run& run, const JobGroup& group, TaskResult& result) {
  const Job& first = group.front()->job;
  const std::string exemplar = exemplar_name(run.config, first);
  const std::string& method = run.config.methods[first.method].name;
  const NothingToKeep scope;
  try {
    const std::vector<NamedRecord> finished = finished_jobs(run, group);
    if (finished.size() < 2) return;
    SeedDiversity diversity = diversity_of_records(exemplar, method, finished);
    diversity.value = diversity_of(run, first, finished);
    write_format(diversity_file(run.options.output, exemplar, method), diversity);
    result.diversity = std::move(diversity);
  } catch (const Interrupted&) {
    result.stopped = true;
  } catch (const std::exception& error) {
    result.error = first_line(error.what());
  }
}

}  // namespace

TaskResult do_task(Run& run, const Task& task) {
  const PlannedJob& planned = job_of(run.plan, task);
  TaskResult result;
  switch (task.kind) {
    case TaskKind::texture:
      with_lock(run, planned, task.waits, result,
                [&] { make_texture(run, planned, task.waits, result); });
      break;
    case TaskKind::scores:
      with_lock(run, planned, true, result, [&] { score(run, planned, result); });
      break;
    case TaskKind::diversity:
      compare_seeds(run, group_of(run.plan, task.job), result);
      break;
  }
  return result;
}

std::vector<JobGroup> groups_of(const Plan& plan) {
  std::vector<JobGroup> groups;
  for (const PlannedJob& planned : plan.jobs) {
    if (groups.empty() || !same_group(*groups.back().front(), planned)) groups.emplace_back();
    groups.back().push_back(&planned);
  }
  return groups;
}

JobGroup group_of(const Plan& plan, int job) {
  auto first = static_cast<std::size_t>(job);
  while (first > 0 && same_group(plan.jobs[first - 1], plan.jobs[first])) --first;
  JobGroup group;
  for (std::size_t i = first; i < plan.jobs.size(); ++i) {
    if (!same_group(plan.jobs[first], plan.jobs[i])) break;
    group.push_back(&plan.jobs[i]);
  }
  return group;
}

int number_of(const Plan& plan, const PlannedJob& planned) {
  return static_cast<int>(&planned - plan.jobs.data());
}

const PlannedJob& job_of(const Plan& plan, const Task& task) {
  return plan.jobs.at(static_cast<std::size_t>(task.job));
}

}  // namespace gramloom
