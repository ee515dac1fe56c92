#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/config.h"
#include "jobs/input_files.h"
#include "jobs/progress_bar.h"
#include "jobs/shard.h"
#include "neural/group.h"

namespace gramloom {

struct RunOptions {
  std::filesystem::path output;          // the folder of all results
  std::string only;                      // pattern of the jobs to do; "": all
  bool resume = false;                   // keep finished jobs, go on with unfinished ones
  std::function<bool()> stop;            // true once the user has asked to stop
  std::vector<std::string> command;      // the command line, for run.json and for processes
  std::optional<Shard> shard;            // this process does a part of the jobs, others do the rest
  int jobs = 1;                          // so many at once, each in a process of its own
  std::filesystem::path program;         // of these processes: gramloom; empty: this one
  std::shared_ptr<neural::Group> group;  // with these processes together; none: alone
  bool is_default_output = false;        // the user named no folder: it is for this config alone
  std::vector<InputFile> inputs;         // that must stay as they are, beside those of the config
};

/// Those of a run into `output`, or into the config's own folder where that is empty.
RunOptions run_options(const Config& config, const std::filesystem::path& output, bool resume,
                       const std::vector<std::string>& command);

inline constexpr int most_jobs = 1024;  // at once

/// Spreads the jobs of a run over processes, as --shard and --jobs say. `shard`: "3/16", "" for
/// what Slurm says, or none; `jobs`: so many at once, 0 for as many as threads. Throws ConfigError.
void spread(RunOptions& options, const Config& config, const std::optional<std::string>& shard,
            int jobs);

/// How the jobs of a run went; `left` were not begun because the user asked to stop.
struct RunSummary {
  int done = 0;
  int skipped = 0;  // finished before
  int failed = 0;
  int interrupted = 0;
  int left = 0;

  bool unscored = false;  // the user stopped the scoring of a texture
  bool lacking = false;   // scores, or files of the run itself, that could not be made or written
  int writes = 0;         // of run.json and scores.csv
};

/// Does the jobs of a config one after another and leaves on disk, in `output`:
///   run.json                         versions, machine, settings, every job's status, diversity
///   scores.csv                       a line a job: time, memory, scores; both follow from the
///                                    records and are written at the start, at the end and now
///                                    and then (run_log.h)
///   <exemplar>/exemplar.png          the exemplar as the methods saw it (.exr, .tif)
///   <exemplar>/<method>/seed<N>.png  the texture (.exr, .tif), its maps as seed<N>_<map>.png
///   <exemplar>/<method>/seed<N>.copy_map.png  where each pixel came from (metrics/scores.h)
///   <exemplar>/<method>/seed<N>.csv  the trace of an iterative method
///   <exemplar>/<method>/seed<N>.json the record, written last, and again with the scores
///   <exemplar>/<method>/seed<N>.checkpoint[.csv]  state of an unfinished job
///   <exemplar>/<method>/seed<N>.lock  while a process does the job
///   <exemplar>/<method>/diversity.json  how unlike the textures of several seeds are
///   run.lock                         while a process writes there
/// Textures made from an exemplar are scored against it, unless the config says scores = false.
/// A job that fails says so in its record and does not stop the others. A finished result stays as
/// it is until the one that replaces it is complete, or has failed.
/// Throws ConfigError before any work when a method refuses its parameters, when no job matches,
/// when `output` cannot be written, or when a file in it is read by this run or no run's.
RunSummary run(const Config& config, const RunOptions& options, ProgressBar& bar);

}  // namespace gramloom
