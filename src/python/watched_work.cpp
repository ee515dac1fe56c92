#include "python/watched_work.h"

#include <exception>
#include <thread>

#include "core/signals_blocked.h"

namespace gramloom::python {

namespace {

constexpr std::chrono::milliseconds interval{50};

std::thread start(const std::function<void()>& work) {
  const SignalsBlocked blocked;
  return std::thread(work);
}

void tell(Watch& watch, const py::object& progress) {
  const auto news = watch.news();
  if (news && !progress.is_none()) progress(*news);
}

}  // namespace

void Watch::report(const std::string& job, const Progress& progress) {
  const std::lock_guard lock(mutex_);
  news_ = JobProgress{job, progress};
}

Control Watch::control() {
  Control control;
  control.progress = [this](const Progress& progress) {
    report("", progress);
    return !stopped();
  };
  return control;
}

void Watch::finish() {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

bool Watch::wait(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, time, [this] { return finished_; });
}

std::optional<JobProgress> Watch::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

void do_watched(const py::object& progress, const std::function<void(Watch&)>& work) {
  Watch watch;
  std::exception_ptr failure;  // of the work
  std::exception_ptr raised;   // by Python
  std::thread thread = start([&] {
    try {
      work(watch);
    } catch (...) {
      failure = std::current_exception();
    }
    watch.finish();
  });
  for (bool finished = false; !finished;) {
    {
      const py::gil_scoped_release others_run;
      finished = watch.wait(interval);
    }
    if (!raised) try {
        tell(watch, progress);
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      } catch (...) {
        raised = std::current_exception();
        watch.stop();
      }
  }
  {
    const py::gil_scoped_release others_run;
    thread.join();
  }
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gramloom::python
