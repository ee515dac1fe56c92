#pragma once

#include <cstddef>
#include <optional>

#include "core/progress.h"
#include "jobs/exemplar.h"
#include "jobs/plan.h"
#include "jobs/runner.h"
#include "metrics/exemplar_statistics.h"
#include "runs/record.h"

namespace gramloom {

/// What all jobs of a run share. The exemplar of the last job is kept for the next one, in its
/// request.
struct Run {
  const Config& config;
  const RunOptions& options;
  const Plan& plan;
  ProgressBar& bar;
  std::optional<std::size_t> loaded = {};
  Request request = {};
  std::vector<ExemplarFile> files = {};                // of that exemplar
  std::optional<ExemplarStatistics> statistics = {};  // of its picture, for the scores

  bool stopped() const { return options.stop && options.stop(); }
};

/// What the job asks of its method. Throws Error for an exemplar that cannot be read.
const Request& request_of(Run& run, const Job& job);

/// The exemplar's side of the scores, kept as long as the exemplar. Throws Error.
ExemplarStatistics& statistics_of(Run& run, const Job& job);

/// Shows the progress of work that leaves nothing to keep when the user stops it.
Control shown_work(Run& run);

/// Makes the job's texture. The record is returned when all files are on disk; what goes wrong is
/// in it. A finished result stays as it is until the one that replaces it is complete, or has
/// failed.
JobRecord run_job(Run& run, const PlannedJob& planned);

}  // namespace gramloom
