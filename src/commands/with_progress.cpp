#include "commands/with_progress.h"

#include "core/error.h"
#include "jobs/interruption.h"

namespace gramloom {

ExitCode with_progress(const std::string& name, bool quiet,
                       const std::function<std::string(const Control&, ProgressBar&)>& work) {
  watch_signals();
  ProgressBar bar(progress_style(quiet));
  bar.start(name, 1, 1);
  Control control;
  control.progress = [&](const Progress& progress) {
    bar.update(progress);
    return !stop_asked();
  };
  try {
    return print(work(control, bar));
  } catch (const Interrupted&) {
    bar.complaint("gramloom: interrupted; nothing is written");
    return interrupted;
  }
}

}  // namespace gramloom
