#include "python/runs.h"

#include "core/error.h"
#include "io/json_fields.h"
#include "io/text_file.h"
#include "jobs/model_entries.h"
#include "jobs/output_guard.h"
#include "jobs/plan.h"
#include "jobs/runner.h"
#include "jobs/training.h"
#include "python/same_build.h"
#include "report/page.h"
#include "runs/job_files.h"
#include "runs/record.h"

namespace gramloom::python {

namespace {

namespace fs = std::filesystem;

// That does the same.
std::vector<std::string> command_line(const RunWork& work, const std::string& command) {
  std::vector<std::string> words{"gramloom", command, work.config.string()};
  const auto add = [&](const std::string& option, const std::string& value) {
    words.push_back(fmt::format("--{}={}", option, value));
  };
  if (!work.output.empty()) add("output", work.output);
  if (!work.only.empty()) add("only", work.only);
  for (const std::string& value : work.set) add("set", value);
  if (work.resume) words.emplace_back("--resume");
  if (work.threads > 0) add("threads", std::to_string(work.threads));
  if (work.jobs != 1) add("jobs", std::to_string(work.jobs));
  if (work.shard && work.shard->empty()) words.emplace_back("--shard");
  if (work.shard && !work.shard->empty()) add("shard", *work.shard);
  return words;
}

RunOptions options_of(const RunWork& work, const Config& config, const std::string& command,
                      Watch& watch) {
  RunOptions options = run_options(config, work.output, work.resume, command_line(work, command));
  options.only = work.only;
  options.stop = [&watch] { return watch.stopped(); };
  spread(options, config, work.shard, work.jobs);
  if (options.jobs > 1) options.program = program_file();
  return options;
}

// A bar that nobody sees: it tells Python.
ProgressBar bar_of(RunDone& done) {
  ProgressBar bar(ProgressStyle::quiet);
  bar.tell([&done](const std::string& line) { done.complaints.push_back(line); });
  return bar;
}

void report_to(Watch& watch, ProgressBar& bar) {
  bar.listen([&](const std::string& job, const Progress& p) { watch.report(job, p); });
}

Plan selected_jobs(const Config& config, const RunOptions& options) {
  if (!options.shard) return list_jobs(config, options.only);
  Plan plan = make_plan(config, options.only);
  select_shard(plan, *options.shard);
  return plan;
}

std::string records_of(const Config& config, const RunOptions& options) {
  auto records = Json::array();
  for (const PlannedJob& planned : selected_jobs(config, options).jobs) {
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
  if (!options.shard) try {
      for (const std::string& trouble : write_page(options.output).trouble)
        bar.complaint(fmt::format("not on the page: {}", trouble));
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
    throw Error("{}", fmt::join(done.complaints, "; "));
  return done;
}

}  // namespace gramloom::python
