#include "signal/opencv_threads.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/threads.h"

namespace gramloom {

void use_threads(int threads) {
  set_thread_count(threads);
  // More than there are cores, and TBB, where OpenCV has it, says so in words of its own.
  cv::setNumThreads(std::min(thread_count(), cv::getNumberOfCPUs()));
}

}  // namespace gramloom
