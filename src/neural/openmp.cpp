#include "neural/openmp.h"

#include <ATen/Parallel.h>
#include <omp.h>

#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "core/threads.h"

namespace gramloom::neural {

namespace {

// How many of `wanted` threads, this one among them, the system lets us have at the same time.
// libgomp itself ends the process when it is refused one.
int obtainable_threads(int wanted) {
  std::mutex gate;
  std::vector<std::thread> threads;
  {
    const std::lock_guard closed(gate);
    try {
      while (static_cast<int>(threads.size()) + 1 < wanted)
        threads.emplace_back([&] { const std::lock_guard through(gate); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
  }
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size()) + 1;
}

// The size of a team that asks for that many.
int team_size(int wanted) {
  int size = 1;
#pragma omp parallel num_threads(wanted)
  {
#pragma omp single
    size = omp_get_num_threads();
  }
  return size;
}

}  // namespace

void start_openmp() {
  omp_set_dynamic(0);
  const int wanted = thread_count();
  const int threads = team_size(obtainable_threads(wanted));
  // Not by at::set_num_threads(), which makes as many threads of a pool of LibTorch's own that
  // nothing here uses, and waits for ever for those that it does not get.
  at::get_num_threads();  // the first call in a thread sets what is set here
  omp_set_num_threads(threads);
  if (threads < wanted) set_thread_count(threads);
}

InThisThread::InThisThread() {
  at::get_num_threads();
  threads_before_ = omp_get_max_threads();
  omp_set_num_threads(1);
  sigset_t signals;
  sigfillset(&signals);
  for (const int own_fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigdelset(&signals, own_fault);
  pthread_sigmask(SIG_BLOCK, &signals, &signals_before_);
}

InThisThread::~InThisThread() {
  pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
  omp_set_num_threads(threads_before_);
}

}  // namespace gramloom::neural
