#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "core/progress.h"
#include "jobs/exemplar.h"
#include "jobs/filling.h"
#include "jobs/inputs.h"
#include "jobs/job_preview.h"
#include "jobs/plan.h"
#include "jobs/runner.h"
#include "metrics/exemplar_statistics.h"
#include "runs/record.h"

namespace gramloom {

/// What a request was read from: which exemplar of the config, if any, and the hashes of its files
/// and of those of [fill] and its like.
struct LoadedFiles {
  std::optional<std::size_t> exemplar;
  std::vector<std::string> hashes;
  Named<std::string> direction;

  friend bool operator==(const LoadedFiles&, const LoadedFiles&) = default;
};

/// What all jobs of a run share. The exemplar of the last job is kept for the next one, in its
/// request.
struct Run {
  const Config& config;
  const RunOptions& options;
  const Plan& plan;
  ProgressBar& bar;
  std::function<void()> keep_up = {};      // to be called now and then while a job is under way
  FileHashes hashes = {};                  // of the files that the jobs read
  std::optional<LoadedFiles> loaded = {};  // what `request` was read from; none: not yet
  Request request = {};
  std::vector<ExemplarFile> files = {};  // of that exemplar
  std::vector<std::string> notes = {};   // likewise: where its values are not those of the files
  Metadata metadata = {};                // of the picture that is filled
  std::optional<Corner> filled_at = {};  // where it lies in the texture, if it is the exemplar
  std::vector<ExemplarStatistics> statistics = {};  // of its pictures, for the scores

  PreviewEnvironments environments = {};  // of the previews

  bool lost = false;    // of options.group: what they did together has failed, and they are apart
  bool halted = false;  // one of it was told to stop

  const PlannedJob* made = nullptr;  // the last job whose texture was made, and
  SourceMap source = {};             // where the pixels of that came from

  bool stopped() const { return halted || (options.stop && options.stop()); }
};

/// What the job asks of its method; its exemplar is read again when its files have changed. Throws
/// Error for an exemplar that cannot be read.
const Request& request_of(Run& run, const Job& job);

/// The exemplar's side of the scores, of each of its pictures, kept as long as the exemplar. Of a
/// picture with a mask, it is that of the largest rectangle that may be used. Throws Error.
std::vector<ExemplarStatistics>& statistics_of(Run& run, const Job& job);

/// Why --resume has to do a job (again); "" when it is finished and what it depended on is as it
/// was: its settings with the content of all files, and the version of gramloom. Other threads,
/// another machine and other versions of libraries change at most the last bits of what neural
/// methods make: they stand in the record and are no reason.
std::string reason_to_run(Run& run, const PlannedJob& planned);
/// Where the pixels of the job's texture came from, empty where its method does not tell. Of a
/// texture that an earlier run made, the method is asked once more.
const SourceMap& source_of(Run& run, const PlannedJob& planned);

/// Shows the progress of work that leaves nothing to keep when the user stops it.
Control shown_work(Run& run);

/// The record of a job whose process is gone, with why: written in place of the one that is there,
/// or, of a texture that is `made` but not scored, as its score_error.
JobRecord fail_job(Run& run, const PlannedJob& planned, bool made, const std::string& why);

/// In a group, of all processes but the first: the own rows of the texture. Throws what goes wrong.
struct OwnRows;
OwnRows make_own_rows(Run& run, const PlannedJob& planned);

/// Makes the job's texture. The record is returned when all files are on disk; what goes wrong is
/// in it. A finished result stays as it is until the one that replaces it is complete, or has
/// failed.
JobRecord run_job(Run& run, const PlannedJob& planned);

}  // namespace gramloom
