#pragma once

#include <c10/core/GradMode.h>
#include <signal.h>

namespace gramloom::neural {

/// Gives the pool of OpenMP, which LibTorch, oneDNN and OpenBLAS share, thread_count() threads, or
/// as many as it can have; set_thread_count() is told if that is fewer. To be called before any
/// work of theirs: OpenBLAS waits for ever for a thread that it asked for and did not get.
void start_openmp();

/// While one lives, those libraries work in this thread alone and record no gradients: for what a
/// body of parallel_for calls, as its loop keeps the cores busy. Signals wait, or find another
/// thread: oneDNN's matrix products keep another pointer in the register of the stack pointer, and
/// a handler's stack would be written into their numbers, or anywhere on the heap.
class InThisThread {
 public:
  InThisThread();
  ~InThisThread();
  InThisThread(const InThisThread&) = delete;

 private:
  c10::NoGradGuard no_gradients_;
  int threads_before_;
  sigset_t signals_before_;
};

}  // namespace gramloom::neural
