#pragma once

namespace gramloom {

/// Sets our number of threads (core/threads.h), 0 for every core that this process may use, and
/// that of OpenCV, which would use every core of the machine. Throws Error as set_thread_count().
void use_threads(int threads);

}  // namespace gramloom
