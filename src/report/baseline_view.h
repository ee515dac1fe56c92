#pragma once

#include <functional>
#include <optional>

#include "io/json_text.h"
#include "runs/comparison.h"
#include "runs/run_folder.h"

namespace gramloom {

/// The comparison of a run with an earlier one, as its baseline.json says; none where there is no
/// such file of ours. One that cannot be read is named in `trouble`.
std::optional<ComparisonRecord> read_comparison(const RunOnDisk& run, Json& trouble);

/// What the page shows of it: {folder, limits, worse, changes [{verdict, job, what, before, now}
/// …], jobs: how many are in both runs, but not alike; old: whether an older gramloom wrote it,
/// which did not say where the earlier pictures are}.
Json baseline_summary(const ComparisonRecord& comparison);

/// What the page shows of one job that is not as it was: {scores {name: value before},
/// pictures [{label, before: file or null, was: where it was} …]}. Earlier pictures are
/// kept in folder/page/before, so that the folder shows them wherever it goes; null where one is
/// neither there nor, as it was compared, in the earlier run's folder. `white` is that of the job's
/// picture of this label (report/preview.h).
Json baseline_job(const RunOnDisk& run, const ComparisonRecord& comparison, const ChangedJob& job,
                  const std::function<double(const std::string& label)>& white, Json& trouble);

}  // namespace gramloom
