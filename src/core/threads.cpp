#include "core/threads.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <thread>

#include "core/control_group.h"
#include "core/error.h"
#include "core/thread_pool.h"

namespace gramloom {

namespace {

constexpr int most_threads = 1024;

std::atomic<int> wanted_threads{0};

// Never destroyed: its threads may outlive main().
ThreadPool& pool() {
  static ThreadPool& pool = *new ThreadPool;
  return pool;
}

// Cores that the scheduler may put this process on (taskset).
int allowed_cores() {
  cpu_set_t cores;
  const int count = sched_getaffinity(0, sizeof cores, &cores) == 0
                        ? CPU_COUNT(&cores)
                        : static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(count, 1, most_threads);
}

// What a container or a service may use of them, rounded up.
int cores_by_quota() {
  double quota = std::min(core_quota("/sys/fs/cgroup/cpu"), double{most_threads});
  for (const auto& group : control_groups()) quota = std::min(quota, core_quota(group));
  return static_cast<int>(std::ceil(quota));
}

// OpenMP's own limit, which holds for the libraries that we share our number of threads with.
int openmp_limit() {
  const char* text = std::getenv("OMP_THREAD_LIMIT");
  const int limit = text ? std::atoi(text) : 0;
  return limit > 0 ? limit : most_threads;
}

}  // namespace

int thread_count() {
  static const int cores = std::min(allowed_cores(), cores_by_quota()), limit = openmp_limit();
  const int wanted = wanted_threads.load();
  return std::min(wanted > 0 ? wanted : cores, limit);
}

void set_thread_count(int threads) {
  if (threads < 0 || threads > most_threads)
    throw Error("threads = {}: allowed are 1 to {}, or 0 for every core", threads, most_threads);
  wanted_threads = threads;
}

void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (count <= 0) return;
  grain = std::max<std::int64_t>(grain, 1);
  const std::int64_t chunks = (count + grain - 1) / grain;
  std::atomic<std::int64_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;
  const auto helpers = std::min<std::int64_t>(thread_count(), chunks) - 1;
  pool().run(static_cast<int>(helpers), [&] {
    for (std::int64_t chunk; !failed && (chunk = next++) < chunks;) try {
        body(chunk * grain, std::min(count, (chunk + 1) * grain));
      } catch (...) {
        if (!failed.exchange(true)) failure = std::current_exception();
      }
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gramloom
