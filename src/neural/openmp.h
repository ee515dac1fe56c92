#pragma once

#include <c10/core/GradMode.h>

namespace gramloom::neural {

/// Gives the pool of OpenMP, which LibTorch, oneDNN and OpenBLAS share, thread_count() threads, or
/// as many as it can have; set_thread_count() is told if that is fewer. To be called before any
/// work of theirs: OpenBLAS waits for ever for a thread that it asked for and did not get.
void start_openmp();

/// While one lives, those libraries work in this thread alone and record no gradients: for what a
/// body of parallel_for calls, as its loop keeps the cores busy.
class InThisThread {
 public:
  InThisThread();
  ~InThisThread();
  InThisThread(const InThisThread&) = delete;

 private:
  c10::NoGradGuard no_gradients_;
  int threads_before_;
};

}  // namespace gramloom::neural
