#pragma once

#include "io/json_text.h"
#include "runs/run_folder.h"

namespace gramloom {

/// The sequences that trained inferences have left in the run's folder, in the order of their
/// names: [{name, frames [{file, shown, width, height, pose {name: number}} …]} …]. `shown` is the
/// file itself or, as browsers show no EXR and values may go below 0, a preview in folder/page:
/// black and white are the least and the largest value of the whole sequence. One that cannot be
/// read is named in `trouble`.
Json sequence_views(const RunOnDisk& run, Json& trouble);

}  // namespace gramloom
