#include "python/runs.h"

#include "core/error.h"
#include "io/json_fields.h"
#include "io/text_file.h"
#include "jobs/model_entries.h"
#include "jobs/output_guard.h"
#include "jobs/plan.h"
#include "jobs/runner.h"
#include "jobs/training.h"
#include "report/page.h"
#include "runs/job_files.h"
#include "runs/record.h"

namespace gramloom::python {

namespace {

namespace fs = std::filesystem;

RunOptions options_of(const RunWork& work, const Config& config, const std::string& command,
                      Watch& watch) {
  RunOptions options =
      run_options(config, work.output, work.resume, {"gramloom." + command, work.config.string()});
  options.only = work.only;
  options.stop = [&watch] { return watch.stopped(); };
  return options;
}

// A bar that nobody sees: it tells Python.
ProgressBar bar_of(RunDone& done) {
  ProgressBar bar(ProgressStyle::quiet);
  bar.tell([&done](const std::string& line) { done.complaints.push_back(line); });
  return bar;
}

void report_to(Watch& watch, ProgressBar& bar) {
  bar.listen([&](const Progress& progress) { watch.report(bar.job(), progress); });
}

std::string records_of(const Config& config, const RunOptions& options) {
  auto records = Json::array();
  for (const PlannedJob& planned : list_jobs(config, options.only).jobs) {
    const JobFiles files = job_files(options.output, planned.name);
    const auto record = planned.selected ? find_record(files.record) : std::nullopt;
    if (!record) continue;
    Json json = to_json_value(*record);
    json["name"] = planned.name;
    json["folder"] = files.folder.string();
    records.push_back(std::move(json));
  }
  return to_text(records);
}

void do_jobs(const Config& config, const RunOptions& options, ProgressBar& bar, RunDone& done) {
  const RunSummary summary = gramloom::run(config, options, bar);
  if (summary.interrupted + summary.left > 0 || summary.unscored) throw Interrupted();
  try {
    write_page(options.output);
  } catch (const Error& error) {
    bar.complaint(fmt::format("no page: {}", first_line(error.what())));
  }
  done.records = records_of(config, options);
}

}  // namespace

RunDone run(const RunWork& work, Watch& watch) {
  const Config config = read_config(work.config, work.set);
  refuse_models(config, "run");
  RunDone done;
  ProgressBar bar = bar_of(done);
  report_to(watch, bar);
  do_jobs(config, options_of(work, config, "run", watch), bar, done);
  return done;
}

RunDone train(const RunWork& work, Watch& watch) {
  const Config config = read_config(work.config, work.set);
  if (config.models.empty())
    throw ConfigError("{}: there is no [[model]] to train", config.file.string());
  const RunOptions options = options_of(work, config, "train", watch);
  RunDone done{"[]", {}};
  ProgressBar bar = bar_of(done);
  report_to(watch, bar);
  const Trained trained = train_models(config, options, bar);
  if (trained.interrupted) throw Interrupted();
  if (const auto textures = textures_of_trained(config, trained, options.only))
    do_jobs(*textures, options, bar, done);
  else if (trained.failed > 0)
    throw Error("{}", fmt::join(done.complaints, "\n"));
  return done;
}

}  // namespace gramloom::python
