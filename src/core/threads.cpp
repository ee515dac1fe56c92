#include "core/threads.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "core/error.h"

namespace gramloom {

namespace {
std::atomic<int> wanted_threads{0};
}

int thread_count() {
  const int wanted = wanted_threads.load();
  return wanted > 0 ? wanted : omp_get_num_procs();
}

void set_thread_count(int threads) {
  if (threads < 0 || threads > 1024)
    throw Error("threads = {}: allowed are 1 to 1024, or 0 for every core", threads);
  wanted_threads = threads;
  omp_set_num_threads(thread_count());
}

void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (count <= 0) return;
  grain = std::max<std::int64_t>(grain, 1);
  const std::int64_t chunks = (count + grain - 1) / grain;
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count()) if (chunks > 1)
  for (std::int64_t chunk = 0; chunk < chunks; ++chunk) {
    if (failed) continue;
    try {
      body(chunk * grain, std::min(count, (chunk + 1) * grain));
    } catch (...) {
#pragma omp critical(gramloom_parallel_for)
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gramloom
