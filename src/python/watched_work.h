#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "core/progress.h"

namespace gramloom::python {

namespace py = pybind11;

/// How far a job is, for Python.
struct JobProgress {
  std::string job;  // "" when there is only one
  Progress progress;
};

/// What long work and the thread that waits for it tell each other.
class Watch {
 public:
  /// For the work: how far it is.
  void report(const std::string& job, const Progress& progress);
  /// For the work: whether it is to stop.
  bool stopped() const { return stop_; }
  /// For the work: reports here, and stops when asked to.
  Control control();

  void stop() { stop_ = true; }
  void finish();
  /// Waits until the work is finished, or for this time; whether it is.
  bool wait(std::chrono::milliseconds time);
  /// What was reported since the last call.
  std::optional<JobProgress> news();

 private:
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool finished_ = false;
  std::optional<JobProgress> news_;
};

/// Does work in a thread of its own, while Python's others run. It must not touch Python. Now and
/// then this thread calls `progress`, unless that is None, and sees to signals: when either raises
/// (Ctrl-C does), the work is asked to stop, and when it has, that is thrown; else what the work
/// has thrown.
///
/// Signals must not find the threads that work (see jobs/interruption.cpp): those that are started
/// here have them blocked, and Python's handlers run in its own.
void do_watched(const py::object& progress, const std::function<void(Watch&)>& work);

}  // namespace gramloom::python
