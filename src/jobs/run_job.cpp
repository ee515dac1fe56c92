#include "jobs/run_job.h"

#include "core/hash.h"
#include "io/text_file.h"
#include "jobs/arrangement.h"
#include "jobs/interruption.h"
#include "jobs/job_preview.h"
#include "jobs/loaded_request.h"
#include "jobs/machine.h"
#include "jobs/memory.h"
#include "jobs/one_job.h"
#include "jobs/results.h"
#include "jobs/settings.h"
#include "jobs/surface_maps.h"
#include "jobs/tasks.h"
#include "jobs/trace_log.h"
#include "jobs/usable_part.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

// The description of the network that the method looks at, if it does.
std::optional<NetworkUsed> network_of(const Method& method) {
  return std::visit(
      []<class Params>(const Params& params) -> std::optional<NetworkUsed> {
        if constexpr (HasNetwork<Params>) {
          const std::filesystem::path file = network_file(params);
          if (!file.empty()) return NetworkUsed{file.string(), read_text(file)};
        }
        return std::nullopt;
      },
      method);
}

JobRecord new_record(Run& run, const Job& job) {
  const MethodEntry& method = run.config.methods[job.method];
  JobRecord record;
  record.exemplar = exemplar_name(run.config, job);
  record.method = method.name;
  record.kind = kind_of(method.method);
  record.seed = job.seed;
  record.size = run.config.size;
  record.settings = job_settings(run.config, job, input_hashes(run.config, job, run.hashes));
  record.machine = machine();
  record.versions = versions();
  record.config = run.config.file.string();
  record.config_hash = hash_of(run.config.text);
  record.set = run.config.overrides;
  record.error = "stopped before it was finished";
  return record;
}

void refuse_if_impossible(const Run& run, const PlannedJob& planned) {
  if (!planned.error.empty()) throw Error("{}", planned.error);
  const double available = available_memory();
  if (const auto& group = run.options.group; group && planned.cost.bytes > available)
    throw Error(
        "needs about {:.1f} GB of memory in each of {} processes, {:.1f} GB are free: start more",
        planned.cost.bytes / 1e9, group->size(), available / 1e9);
  const std::string refusal = memory_refusal(run.config, run.plan, planned, available);
  if (!refusal.empty()) throw Error("{}", refusal);
}

// A job under way: what it reads and where its results go.
struct JobWork {
  const PlannedJob& planned;
  const Method& method;
  const JobFiles& files;
  const Request& request;
  Named<std::string> method_files;  // by their content when the work began
  std::string identity;             // of all that the result depends on
};

// The texture, and whether the user stopped the work before it was finished.
struct Made {
  Texture texture;
  bool stopped = false;
};

Image first_row(const Image& image) {
  Image row(image.width, 1, image.channels);
  std::copy_n(image.pixels.begin(), row.pixels.size(), row.pixels.begin());
  return row;
}

// A method reads its files before its first report: what was hashed before is what it has read.
void check_unchanged(Run& run, const JobWork& work) {
  if (method_hashes(work.method, run.hashes) != work.method_files)
    throw Error("a file of the method '{}' changed while it was read",
                run.config.methods[work.planned.job.method].name);
}

// With the other processes of the group, of which this is the first.
Made make_with_others(Run& run, const JobWork& work, const Control& control) {
  const neural::Group& group = *run.options.group;
  run.lost = true;  // unless all goes well, until the others' rows have come
  say_next(group, number_of(run.plan, work.planned));
  begin_together(group, work.identity);
  OwnRows rows =
      make_together(group, work.method, work.request, control, [&] { return run.stopped(); });
  run.halted = rows.stopped;
  return {{std::move(rows.image)}, rows.stopped};
}

Made make_texture(Run& run, const JobWork& work, TraceLog& trace) {
  Made made;
  bool checked = false;
  Control control;
  if (!run.options.group) control.checkpoint = work.files.checkpoint;
  control.identity = work.identity;
  control.progress = [&](const Progress& progress) {
    if (!std::exchange(checked, true)) check_unchanged(run, work);
    trace.add(progress);
    run.bar.update(progress);
    if (run.keep_up) run.keep_up();
    made.stopped = run.stopped();
    return !made.stopped;
  };
  std::optional<NothingToKeep> scope;
  if (!std::holds_alternative<NeuralParams>(work.method)) scope.emplace();
  if (run.options.group)
    made = make_with_others(run, work, control);
  else
    made.texture = run_method(work.method, work.request, control);
  if (!checked) check_unchanged(run, work);
  return made;
}

void write_results(Run& run, const JobWork& work, Texture joined, const TraceLog& trace,
                   JobRecord& record) {
  const JobFiles& files = work.files;
  const neural::Group* group = run.options.group.get();
  Image own_rows;
  if (group) own_rows = std::exchange(joined.image, first_row(joined.image));
  Texture texture = split_layers(std::move(joined), run.files);
  record.notes = run.notes;
  add_surface_maps(texture, run.config, work.planned.job, record.notes);
  const OutputFormats formats = output_formats(run.config, run.files, texture);
  const WrittenTexture written =
      group ? write_together(*group, own_rows, run.config, run.files, files.folder, files.name,
                             formats, record.settings, run.metadata)
            : write_texture(files.folder, files.name, texture, formats, record.settings,
                            run.metadata);
  record.files = written.files;
  record.normals = normals_of(formats);
  if (run.config.coordinates && run.source.empty())
    record.notes.push_back("no coordinates: this method copies no pixels");
  else if (run.config.coordinates)
    record.files.push_back(write_arrangement(
        files.folder, files.name, arrangement_of(run.source, work.request, run.filled_at)));
  std::ranges::move(write_previews(files.folder, files.name, run.config,
                                   previews_of(run.config, work.planned.job),
                                   texture_metadata(formats.picture, record.settings, {}),
                                   {work.method, work.request.random, texture, formats}, run.hashes,
                                   run.environments, shown_work(run), record.notes),
                    std::back_inserter(record.files));
  record.notes.insert(record.notes.end(), written.notes.begin(), written.notes.end());
  record.texture = file_hash(files.folder / record.files.front());
  record.loss = summarise(trace.trace());
  if (record.loss)
    write_text(files.trace, to_csv(trace.trace()));
  else
    remove_file(files.trace);
  remove_file(files.copy_map);  // of the texture before
  write_record(files.record, record);
}

// Reads what the job needs, and says so in the record.
JobWork begin_work(Run& run, const PlannedJob& planned, const JobFiles& files, JobRecord& record) {
  const Job& job = planned.job;
  const Method& method = run.config.methods[job.method].method;
  const Request& request = request_of(run, job);
  InputHashes inputs{run.loaded->hashes, run.loaded->direction, method_hashes(method, run.hashes),
                     preview_hashes(run.config, job, run.hashes)};
  record.settings = job_settings(run.config, job, inputs);
  record.network = network_of(method);
  const std::string identity = hash_of(to_text(record.settings) + std::string(version()));
  return {planned, method, files, request, std::move(inputs.method), identity};
}

// Does the job and writes its files; throws what goes wrong.
void do_job(Run& run, const PlannedJob& planned, const JobFiles& files, bool keep_old,
            JobRecord& record) {
  refuse_if_impossible(run, planned);
  reset_peak_memory();
  const JobWork work = begin_work(run, planned, files, record);
  TraceLog trace(files.checkpoint_trace, work.identity);
  if (!run.options.resume || !trace.continues() || !exists(files.checkpoint)) {
    trace.restart();
    remove_file(files.checkpoint);
  }
  Made made = make_texture(run, work, trace);
  run.made = &planned;
  run.source = std::move(made.texture.source);
  record.seconds = trace.seconds();
  record.peak_memory_mb = peak_memory() / 1e6;
  const bool written = !made.stopped || !keep_old;
  if (run.options.group) run.options.group->any(written);  // whether it wants the others' rows
  if (!written) {
    run.lost = false;
    return;
  }
  // A finished result's files are now replaced one after another: until all are, there is none.
  if (keep_old) write_record(files.record, record);
  if (!made.stopped) {
    record.status = Status::done;
    record.error.clear();
  }
  write_results(run, work, std::move(made.texture), trace, record);
  run.lost = false;
  if (!made.stopped) remove_unfinished_state(files);
}

}  // namespace

const Request& request_of(Run& run, const Job& job) {
  // The seed alone: a texture does not change when its exemplar or method is given another name.
  run.request.random = Random(static_cast<std::uint64_t>(job.seed));
  const auto files_now = [&] {
    LoadedFiles files{job.exemplar, {}, direction_hashes(run.config.direction, run.hashes)};
    if (job.exemplar)
      files.hashes = exemplar_hashes(run.config.exemplars[*job.exemplar], run.hashes);
    return files;
  };
  LoadedFiles files = files_now();
  if (run.loaded == files) return run.request;
  const NothingToKeep scope;
  run.loaded.reset();
  run.request.exemplars.clear();
  run.statistics.clear();
  LoadedRequest loaded = load_request(run.config, job.exemplar);
  if (files_now() != files)
    throw Error("{}: the exemplar or one of its maps changed while it was read",
                job.exemplar ? run.config.exemplars[*job.exemplar].image.string()
                             : run.config.file.string());
  run.request.exemplars = std::move(loaded.exemplars);
  run.request.target = std::move(loaded.target);
  run.files = std::move(loaded.files);
  run.notes = std::move(loaded.notes);
  run.metadata = std::move(loaded.metadata);
  run.filled_at = loaded.filled_at;
  run.loaded = std::move(files);
  return run.request;
}

std::vector<ExemplarStatistics>& statistics_of(Run& run, const Job& job) {
  const Request& request = request_of(run, job);
  if (run.statistics.empty())
    for (const Exemplar& exemplar : request.exemplars)
      run.statistics.emplace_back(cut_out(picture_of(exemplar), usable_part(exemplar)));
  return run.statistics;
}

std::string reason_to_run(Run& run, const PlannedJob& planned) {
  const JobFiles files = job_files(run.options.output, planned.name);
  std::error_code ignored;
  if (!std::filesystem::exists(files.record, ignored)) return "not done before";
  std::optional<JobRecord> record;
  try {
    record = read_record(files.record);
  } catch (const Error& error) {
    return error.what();
  }
  if (record->status != Status::done) return fmt::format("was {} before", to_word(record->status));
  if (!is_finished(record, files.folder)) return "its picture is gone";
  // Records of version 1 don't know it.
  for (const auto& [name, made_by] : record->versions)
    if (name == "gramloom" && made_by != version())
      return fmt::format("made by gramloom {}, this is {}", made_by, version());
  const InputHashes inputs = input_hashes(run.config, planned.job, run.hashes);
  const Json changes = Json::diff(record->settings, job_settings(run.config, planned.job, inputs));
  if (changes.empty()) return "";
  return fmt::format("{} changed since", changes.front().at("path").get<std::string>().substr(1));
}

const SourceMap& source_of(Run& run, const PlannedJob& planned) {
  if (run.made != &planned) {
    const Method& method = run.config.methods[planned.job.method].method;
    run.made = nullptr;
    run.source = {};
    if (abilities_of(method).has(Ability::source))
      run.source = run_method(method, request_of(run, planned.job), shown_work(run)).source;
    run.made = &planned;
  }
  return run.source;
}

Control shown_work(Run& run) {
  Control control;
  control.progress = [&run](const Progress& progress) {
    run.bar.update(progress);
    if (run.keep_up) run.keep_up();
    return !run.stopped();
  };
  return control;
}

JobRecord fail_job(Run& run, const PlannedJob& planned, bool made, const std::string& why) {
  const JobFiles files = job_files(run.options.output, planned.name);
  JobRecord record = new_record(run, planned.job);
  const auto before = find_record(files.record);
  if (made && before) {
    record = *before;
    record.score_error = why;
  } else {
    record.status = Status::failed;
    record.error = why;
  }
  try {
    write_record(files.record, record);
  } catch (const Error&) {
    // The terminal says so.
  }
  return record;
}

OwnRows make_own_rows(Run& run, const PlannedJob& planned) {
  const neural::Group& group = *run.options.group;
  const JobFiles files = job_files(run.options.output, planned.name);
  JobRecord record = new_record(run, planned.job);
  std::optional<JobWork> work;
  try {
    refuse_if_impossible(run, planned);
    work.emplace(begin_work(run, planned, files, record));
  } catch (const std::exception&) {
    say_unready(group);
    throw;
  }
  begin_together(group, work->identity);
  Control control;
  control.progress = [&](const Progress&) { return !run.stopped(); };
  return make_together(group, work->method, work->request, control, [&] { return run.stopped(); });
}

JobRecord run_job(Run& run, const PlannedJob& planned) {
  const JobFiles files = job_files(run.options.output, planned.name);
  JobRecord record = new_record(run, planned.job);
  const auto fail = [&](const std::string& why) {
    record.status = Status::failed;
    record.error = first_line(why);
    try {
      write_record(files.record, record);
    } catch (const Error&) {
      // The disk may be what failed; the terminal says so.
    }
  };
  const std::optional<JobRecord> before = find_record(files.record);
  const bool keep_old = is_finished(before, files.folder);
  try {
    create_folder(files.folder);
    if (!keep_old) write_record(files.record, record);
    do_job(run, planned, files, keep_old, record);
    if (before && record.status == Status::done)
      remove_replaced(files, before->files, record.files);
  } catch (const Interrupted&) {
    record.status = Status::interrupted;
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  return record;
}

}  // namespace gramloom
