#pragma once

#include <cstdint>
#include <functional>

namespace gramloom {

/// Threads for all parallel work of the process (one OpenMP pool, shared with LibTorch and
/// OpenBLAS). Default: every core that the process may use.
int thread_count();
/// 0: every core. Throws Error when negative or above 1024.
void set_thread_count(int threads);

/// Calls body(begin, end) on disjoint ranges that cover [0, count), in parallel; ranges are about
/// `grain` long. The split does not depend on the number of threads, so a body that keeps one
/// partial result a range gives the same bytes for any of them. The first exception of a body is
/// thrown again here once all have stopped.
void parallel_for(std::int64_t count, std::int64_t grain,
                  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

}  // namespace gramloom
