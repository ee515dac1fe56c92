#include "commands/end_run.h"

#include <malloc.h>

#include "io/text_file.h"
#include "jobs/interruption.h"
#include "jobs/output_guard.h"
#include "report/page.h"

namespace gramloom {

namespace {

// The results are there whatever becomes of the page.
bool show_run(const std::filesystem::path& folder, ProgressBar& bar) {
  const NothingToKeep scope;
  try {
    const WrittenPage page = write_page(folder);
    for (const std::string& trouble : page.trouble)
      bar.complaint(fmt::format("gramloom: not on the page: {}", trouble));
    bar.message(fmt::format("page: {}", page.file.string()));
    return page.trouble.empty();
  } catch (const std::exception& error) {
    bar.complaint(fmt::format("gramloom: no page: {}", first_line(error.what())));
    return false;
  }
}

}  // namespace

void keep_large_buffers() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 2147483647);
}

RunOptions begin_run(const Config& config, const std::string& output, bool resume,
                     const std::vector<std::string>& words) {
  watch_signals();
  RunOptions options = run_options(config, output, resume, words);
  options.stop = stop_asked;
  return options;
}

ExitCode end_run(const RunOptions& options, const RunSummary& summary, ProgressBar& bar) {
  bool shown = true;
  if (!options.shard)
    shown = show_run(options.output, bar);
  else
    bar.message(
        fmt::format("gramloom report {} makes the page of all shards", options.output.string()));
  if (options.group && summary.failed > 0 && summary.left > 0) {
    bar.complaint(fmt::format("gramloom: the processes are apart, {} jobs are left", summary.left));
    return job_failed;
  }
  if (summary.interrupted + summary.left > 0) {
    bar.complaint(fmt::format(
        "gramloom: interrupted, {} of {} jobs are left; --resume goes on",
        summary.interrupted + summary.left,
        summary.done + summary.skipped + summary.failed + summary.interrupted + summary.left));
    return interrupted;
  }
  if (summary.unscored) {
    bar.complaint("gramloom: interrupted, not all textures are scored; --resume goes on");
    return interrupted;
  }
  return !shown || summary.failed > 0 || summary.lacking ? job_failed : all_done;
}

}  // namespace gramloom
