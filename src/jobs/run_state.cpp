#include "jobs/run_state.h"

#include <algorithm>

#include "io/text_file.h"
#include "jobs/keep_exemplar.h"
#include "runs/file_lock.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::string outcome(const PlannedJob& planned, const JobRecord& record) {
  if (record.status == Status::failed)
    return fmt::format("{}: failed: {}", planned.name, record.error);
  std::string text =
      fmt::format("{}: {} in {:.1f} s", planned.name, to_word(record.status), record.seconds);
  if (record.loss) text += fmt::format(", loss {:.3e}", record.loss->last);
  return text;
}

void count_outcome(RunSummary& summary, Status status) {
  switch (status) {
    case Status::done:
      ++summary.done;
      break;
    case Status::failed:
      ++summary.failed;
      break;
    case Status::interrupted:
      ++summary.interrupted;
      break;
    case Status::waiting:  // no job that was begun
      break;
  }
}

// Whether this run, in whichever process, is still to end the job.
bool is_open(const Run& run, const PlannedJob& planned) {
  if (!job_matches(run.options.only, planned.name)) return false;
  const auto record = find_record(job_files(run.options.output, planned.name).record);
  return !record || (record->status != Status::done && record->status != Status::failed);
}

void complain(RunState& state, const std::string& line) {
  state.run.bar.complaint(line);
  state.summary.lacking = true;
}

// Once for an exemplar and a method: the next seed has the same, but for its files' names.
void tell_notes(RunState& state, const PlannedJob& planned, const JobRecord& record) {
  const std::string seed = fs::path(planned.name).filename().string();
  for (const std::string& note : record.notes) {
    const std::string_view what =
        std::string_view(note).substr(note.starts_with(seed) ? seed.size() : 0);
    if (state.noted.insert(fmt::format("{}: {}", job_folder(state.run.config, planned.job), what))
            .second)
      state.run.bar.message(fmt::format("note: {}: {}", planned.name, note));
  }
}

void put_down(RunState& state, const PlannedJob& planned, const JobRecord& record) {
  state.log.set(planned.name, record);
  or_complain(state.run, [&] { state.log.keep_up(); });
}

}  // namespace

std::optional<JobRecord> finished_before(RunState& state, const PlannedJob& planned) {
  Run& run = state.run;
  if (!run.options.resume) return std::nullopt;
  const JobFiles files = job_files(run.options.output, planned.name);
  const std::string reason = reason_to_run(run, planned);
  if (reason.empty()) {
    remove_unfinished_state(files);
    if (const auto lock = take_stale_lock(files.lock)) remove_stale_temporaries(files);
    return find_record(files.record);
  }
  if (fs::exists(files.record)) run.bar.message(fmt::format("{}: again, {}", planned.name, reason));
  return std::nullopt;
}

void settle_texture(RunState& state, const PlannedJob& planned, const TaskResult& result) {
  ProgressBar& bar = state.run.bar;
  if (!result.elsewhere.empty()) {
    bar.message(fmt::format("{}: is done by {}", planned.name, result.elsewhere));
    return;
  }
  if (!result.record) {  // the user stopped it before it began
    ++state.summary.left;
    return;
  }
  const JobRecord& record = *result.record;
  count_outcome(state.summary, record.status);
  if (record.status == Status::done && planned.job.exemplar)
    state.made.insert(*planned.job.exemplar);
  const std::string text = outcome(planned, record);
  record.status == Status::failed ? bar.complaint(text) : bar.message(text);
  tell_notes(state, planned, record);
  put_down(state, planned, record);
}

void settle_finished_before(RunState& state, const PlannedJob& planned, const JobRecord& record) {
  ++state.summary.skipped;
  state.run.bar.message(planned.name + ": finished before");
  put_down(state, planned, record);
}

void settle_scores(RunState& state, const PlannedJob& planned, const TaskResult& result) {
  if (result.stopped) state.summary.unscored = true;
  if (!result.error.empty())
    complain(state, fmt::format("{}: not scored: {}", planned.name, result.error));
  if (result.stopped || !result.record) return;
  if (!result.record->score_error.empty())
    complain(state, fmt::format("{}: not scored: {}", planned.name, result.record->score_error));
  put_down(state, planned, *result.record);
}

void settle_diversity(RunState& state, const JobGroup& group, const TaskResult& result) {
  if (result.stopped) state.summary.unscored = true;
  if (!result.error.empty())
    complain(state, fmt::format("{}: no diversity: {}",
                                job_folder(state.run.config, group.front()->job), result.error));
  if (!result.diversity) return;
  state.log.set(*result.diversity);
  or_complain(state.run, [&] { state.log.keep_up(); });
}

bool wants_diversity(RunState& state, const JobGroup& group) {
  const Run& run = state.run;
  const Job& first = group.front()->job;
  const bool selected = std::any_of(group.begin(), group.end(),
                                    [](const auto* planned) { return planned->selected; });
  if (!run.config.scores || run.config.direction.fill || !first.exemplar || !selected) return false;
  if (!run.options.shard)
    remove_stale_temporaries(run.options.output / job_folder(run.config, first), "diversity");
  // Whichever process ends the last of them compares them.
  if (run.options.shard && std::any_of(group.begin(), group.end(),
                                       [&](const auto* planned) { return is_open(run, *planned); }))
    return false;
  try {
    const std::vector<NamedRecord> finished = finished_jobs(run, group);
    if (finished.size() < 2) return false;
    return !state.log.knows(diversity_of_records(exemplar_name(run.config, first),
                                                 run.config.methods[first.method].name, finished));
  } catch (const Error& error) {
    complain(state,
             fmt::format("{}: no diversity: {}", job_folder(run.config, first), error.what()));
    return false;
  }
}

void keep_exemplar(RunState& state, const Job& job, std::optional<std::size_t>& kept) {
  Run& run = state.run;
  if (job.exemplar == kept || !job.exemplar) return;
  if (!run.plan.exemplars[*job.exemplar].error.empty()) return;  // its jobs say so
  const Request* request = nullptr;
  try {
    request = &request_of(run, job);
  } catch (const std::exception& error) {  // the job, which needs it too, says so; or has it
    state.unkept[*job.exemplar] = first_line(error.what());
    return;
  }
  kept = job.exemplar;
  state.unkept.erase(*job.exemplar);
  const bool written = or_complain(run, [&] {
    const fs::path folder = run.options.output / exemplar_name(run.config, job);
    create_folder(folder);
    if (!run.options.shard) {  // another process may be writing its own
      remove_stale_temporaries(folder, "exemplar");
      remove_stale_temporaries(folder, "target");
    }
    write_exemplar(folder, *request, run.files);
  });
  if (!written) state.summary.lacking = true;
}

void tell_unkept(RunState& state) {
  for (const auto& [exemplar, why] : state.unkept)
    if (state.made.contains(exemplar))
      complain(state, fmt::format("{}: not beside its results: {}",
                                  state.run.config.exemplars[exemplar].name, why));
}

bool or_complain(const Run& run, const std::function<void()>& write) {
  try {
    write();
  } catch (const Error& error) {
    run.bar.complaint(error.what());
    return false;
  }
  return true;
}

}  // namespace gramloom
