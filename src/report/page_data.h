#pragma once

#include "io/json_text.h"
#include "runs/run_folder.h"

namespace gramloom {

/// What the page shows, as the JSON that its script reads; every path is relative to the folder:
///   title, run {date, command, config, set, direction, versions, machine}, trouble [text …]
///   metrics    [{name, group, meaning, range, higher_is_better, paper, fooled_by} …]
///   exemplars  [{name, picture {file, width, height} or null, image: its path in the config,
///                maps {name: path …}, likewise, map_pictures [{label, file} …],
///                mask, guide, more [{image, maps, mask, guide} …]} …]
///   methods    [name …], in the order of the jobs
///   baseline   how the run differs from an earlier one (report/baseline_view.h), or null
///   sequences  of trained inferences (report/sequence_view.h)
///   trainings  of models (report/training_view.h)
///   jobs       [{name, exemplar, method, kind, seed, width, height, status, error, seconds,
///                peak_memory_mb, settings, metrics, score_error, copy_map, machine,
///                origin {config, set, threads, edited: whether the config has changed since},
///                pictures [{label, file} …]: the texture, then its maps,
///                view: script with copies of them for the lit view (report/surface_view.h), or
///                null; exemplars have one, too,
///                live {file, tile}: script that makes it anew (report/live_view.h), or null,
///                trace {steps, seconds, loss} or null,
///                before: what it was in that earlier run, where that is not the same} …]
///   diversity  [{exemplar, method, value} …]
/// Makes previews of pictures that browsers do not show (see shown_file). A picture that is missing
/// or broken is left out and named in `trouble`.
Json page_data(const RunOnDisk& run);

/// `trace` thinned out to at most `most` points, the first and the last among them, as {steps,
/// seconds, loss}.
Json thin_trace(const Trace& trace, std::size_t most);

}  // namespace gramloom
