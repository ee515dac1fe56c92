#include "jobs/worker.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <iostream>
#include <utility>

#include "core/hash.h"
#include "jobs/settings.h"

namespace gramloom {

namespace {

constexpr std::chrono::milliseconds between_answers{200};

// A parent that gets no answer must not wait for it.
void answer(const WorkerAnswer& answer) {
  const std::string line = to_text(to_json_value(answer), -1) + "\n";
  std::size_t written = 0;
  while (written < line.size()) {
    const ssize_t some = write(worker_answers, line.data() + written, line.size() - written);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) _exit(1);
    written += static_cast<std::size_t>(some);
  }
}

// Tells the parent now and then how far a task is.
class Teller {
 public:
  void operator()(const std::string&, const Progress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (progress.steps <= 0 || now - told_ < between_answers) return;
    told_ = now;
    answer({std::clamp(static_cast<double>(progress.step) / static_cast<double>(progress.steps),
                       0.0, 1.0),
            {}});
  }

 private:
  std::chrono::steady_clock::time_point told_;
};

}  // namespace

std::string worker_greeting(const Config& config) {
  return hash_of(config.text + to_text(config_to_json(config)));
}

void work_for_parent(const Config& config, const RunOptions& options) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  std::string line;
  if (!std::getline(std::cin, line)) return;
  if (line != worker_greeting(config))
    throw Error("{} has changed since the run began", config.file.string());
  ProgressBar bar(ProgressStyle::quiet);
  bar.listen(Teller());
  Plan plan = list_jobs(config, options.only);
  Run run{config, options, plan, bar};
  while (!run.stopped() && std::getline(std::cin, line)) {
    const auto task = from_json_value<Task>(parse_json(line), {"a task", "", false});
    if (std::cmp_greater_equal(task.job, plan.jobs.size()))
      throw Error("there is no job {}", task.job);
    plan_job(config, plan, static_cast<std::size_t>(task.job));
    answer({1, do_task(run, task)});
  }
}

}  // namespace gramloom
