#pragma once

#include "io/json_text.h"
#include "runs/run_folder.h"

namespace gramloom {

/// The models that a training has left in the run's folder, in the order of their names: [{name,
/// file, trace (report/page_data.h, or null), trace_file, samples [{file, step (null: held out),
/// width, height} …]} …]. What cannot be read is named in `trouble`.
Json training_views(const RunOnDisk& run, Json& trouble);

}  // namespace gramloom
