#pragma once

#include <cstdint>
#include <functional>

namespace gramloom {

/// Threads for all parallel work: by default the cores that affinity and the quotas of control
/// groups allow, never more than OMP_THREAD_LIMIT. LibTorch has its own, as many, by OpenMP.
int thread_count();
/// 0: every core. Throws Error when negative or above 1024.
void set_thread_count(int threads);

/// Calls body(begin, end) on disjoint ranges that cover [0, count), in parallel, each about `grain`
/// long: the same split and so the same bytes for any threads. Does without threads that the system
/// refuses. Inside a body, another loop runs in the body's thread. The first exception of a body is
/// thrown again here once all have stopped.
void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

}  // namespace gramloom
