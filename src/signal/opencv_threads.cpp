#include "signal/opencv_threads.h"

#include <opencv2/core.hpp>

#include "core/threads.h"

namespace gramloom {

void use_threads(int threads) {
  set_thread_count(threads);
  cv::setNumThreads(thread_count());
}

}  // namespace gramloom
