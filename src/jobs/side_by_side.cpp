#include "jobs/side_by_side.h"

#include <poll.h>

#include <algorithm>
#include <deque>
#include <list>
#include <memory>

#include "core/threads.h"
#include "jobs/memory.h"
#include "jobs/worker_process.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

constexpr int wait_milliseconds = 200;  // until the bar and the user's wish are looked at

struct Worker {
  std::unique_ptr<WorkerProcess> process = {};  // none: to be started
  std::optional<Task> task = {};
  double bytes = 0;  // that its task is expected to take
  double part = 0;   // of it that is done
};

class SideBySide {
 public:
  explicit SideBySide(RunState& state)
      : state_(state),
        run_(state.run),
        groups_(groups_of(run_.plan)),
        workers_(static_cast<std::size_t>(run_.options.jobs)),
        memory_(available_memory()) {}

  void work() {
    line_up();
    while (!tasks_.empty() || is_busy()) {
      if (run_.stopped()) stop();
      give_tasks();
      show();
      listen();
    }
  }

 private:
  // What is to be done of each group, and which of its jobs are not settled.
  void line_up() {
    unsettled_.resize(groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const PlannedJob* planned : groups_[g]) {
        group_of_.push_back(g);
        if (!planned->selected) continue;
        ++count_;
        ++unsettled_[g];
        tasks_.push_back({TaskKind::texture, number_of(run_.plan, *planned)});
      }
  }

  std::size_t group_of(const Task& task) const {
    return group_of_[static_cast<std::size_t>(task.job)];
  }

  bool is_busy() const {
    return std::any_of(workers_.begin(), workers_.end(), [](const Worker& w) { return !!w.task; });
  }

  void stop() {
    for (const Task& task : tasks_)
      if (task.kind == TaskKind::texture)
        ++state_.summary.left;
      else
        state_.summary.unscored = true;
    tasks_.clear();
    if (std::exchange(stopping_, true)) return;
    for (Worker& worker : workers_)
      if (worker.process) worker.process->stop();
  }

  // --- handing out ------------------------------------------------------------------------------

  // Those that an earlier run finished cost no process.
  bool was_finished(const Task& task) {
    if (task.kind != TaskKind::texture) return false;
    const PlannedJob& planned = job_of(run_.plan, task);
    const auto record = finished_before(state_, planned);
    if (!record) return false;
    settle_finished_before(state_, planned, *record);
    go_on(task, *record);
    return true;
  }

  double bytes_of(const Task& task) const {
    const PlannedJob& planned = job_of(run_.plan, task);
    return program_memory(run_.config.methods[planned.job.method].method) +
           std::max({planned.cost.bytes, planned.finishing.bytes, planned.scoring.bytes});
  }

  void give_tasks() {
    for (Worker& worker : workers_)
      while (!worker.task && !run_.stopped())
        if (!give_first_that_fits(worker)) break;
  }

  // The first in line that fits beside the others; alone, whatever it is. False: there is none.
  bool give_first_that_fits(Worker& worker) {
    double in_use = 0;
    for (const Worker& other : workers_) in_use += other.bytes;
    const auto fits = std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& task) {
      return in_use == 0 || in_use + bytes_of(task) <= memory_;
    });
    if (fits == tasks_.end()) return false;
    const Task task = *fits;
    tasks_.erase(fits);
    if (!was_finished(task)) give(worker, task);
    return true;
  }

  void give(Worker& worker, const Task& task) {
    if (task.kind == TaskKind::texture) keep_exemplar(state_, job_of(run_.plan, task).job, kept_);
    try {
      if (worker.process && worker.process->has_ended()) worker.process.reset();
      if (!worker.process)
        worker.process = std::make_unique<WorkerProcess>(
            run_.options.program, run_.options.command,
            std::max(1, thread_count() / run_.options.jobs), worker_greeting(run_.config));
    } catch (const Error& error) {
      settle(task, failure(task, error.what()));
      return;
    }
    worker.task = task;
    worker.bytes = bytes_of(task);
    worker.part = 0;
    if (!worker.process->ask(task)) lose(worker);
  }

  // --- what comes back --------------------------------------------------------------------------

  void listen() {
    std::vector<pollfd> polled;
    std::vector<Worker*> asked;
    for (Worker& worker : workers_)
      if (worker.task) {
        polled.push_back({worker.process->descriptor(), POLLIN, 0});
        asked.push_back(&worker);
      }
    if (polled.empty()) return;
    poll(polled.data(), polled.size(), wait_milliseconds);
    for (std::size_t i = 0; i < polled.size(); ++i)
      if (polled[i].revents != 0 || asked[i]->process->has_ended()) hear(*asked[i]);
  }

  void hear(Worker& worker) {
    const auto answers = worker.process->answers();
    if (!answers) {
      lose(worker);
      return;
    }
    for (const WorkerAnswer& answer : *answers) {
      worker.part = answer.part;
      if (answer.result) finish(worker, *answer.result);
    }
  }

  // A worker that has ended, or cannot be spoken to. Once the user has stopped the run that is no
  // fault of the job's.
  void lose(Worker& worker) {
    const std::string why = "its process " + worker.process->how_it_ended();
    worker.process.reset();
    TaskResult stopped;
    stopped.stopped = true;
    finish(worker, stopping_ || run_.stopped() ? stopped : failure(*worker.task, why));
  }

  void finish(Worker& worker, const TaskResult& result) {
    const Task task = *std::exchange(worker.task, std::nullopt);
    worker.bytes = worker.part = 0;
    settle(task, result);
  }

  // Of a task whose process is gone: a texture's record says so, too.
  TaskResult failure(const Task& task, const std::string& why) {
    TaskResult result;
    if (task.kind == TaskKind::diversity)
      result.error = why;
    else
      result.record = fail_job(run_, job_of(run_.plan, task), task.kind == TaskKind::scores, why);
    return result;
  }

  void settle(const Task& task, const TaskResult& result) {
    const PlannedJob& planned = job_of(run_.plan, task);
    switch (task.kind) {
      case TaskKind::texture:
        settle_texture(state_, planned, result);
        break;
      case TaskKind::scores:
        settle_scores(state_, planned, result);
        break;
      case TaskKind::diversity:
        settle_diversity(state_, groups_[group_of(task)], result);
        return;
    }
    if (!result.elsewhere.empty() && !stopping_)
      tasks_.push_back({task.kind, task.job, true});  // whoever has it may die
    else if (result.record)
      go_on(task, *result.record);
    else
      settled(task);
  }

  // Scores follow the texture, and what compares textures the last of them.
  void go_on(const Task& task, const JobRecord& record) {
    const PlannedJob& planned = job_of(run_.plan, task);
    if (task.kind != TaskKind::texture || !lacks_scores(run_, planned, record))
      settled(task);
    else if (stopping_)
      state_.summary.unscored = true;
    else
      tasks_.push_front({TaskKind::scores, task.job});
  }

  void settled(const Task& task) {
    ++settled_;
    const std::size_t group = group_of(task);
    if (--unsettled_[group] > 0 || stopping_ || !wants_diversity(state_, groups_[group])) return;
    tasks_.push_front({TaskKind::diversity, task.job});
  }

  void show() {
    double parts = static_cast<double>(settled_);
    std::string at_work;
    for (const Worker& worker : workers_) {
      if (!worker.task) continue;
      if (worker.task->kind == TaskKind::texture) parts += worker.part;
      at_work += (at_work.empty() ? "" : ", ") + job_of(run_.plan, *worker.task).name;
    }
    run_.bar.show_jobs(parts, settled_, count_, at_work);
    if (run_.keep_up) run_.keep_up();
  }

  RunState& state_;
  Run& run_;
  std::vector<JobGroup> groups_;
  std::vector<std::size_t> group_of_;   // of each job of the plan
  std::vector<std::size_t> unsettled_;  // jobs of each group
  std::deque<Task> tasks_;
  std::list<Worker> workers_;
  double memory_;                    // for all of them
  std::optional<std::size_t> kept_;  // the exemplar that lies beside its results
  std::size_t count_ = 0, settled_ = 0;
  bool stopping_ = false;
};

}  // namespace

void do_side_by_side(RunState& state) { SideBySide(state).work(); }

}  // namespace gramloom
