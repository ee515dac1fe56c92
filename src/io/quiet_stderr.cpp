#include "io/quiet_stderr.h"

#include <cstdio>
#include <mutex>

namespace gramloom {

namespace {

std::mutex mutex;
int count = 0;
std::FILE* own = nullptr;  // the process's stderr, while it is away

// Never closed: another thread may still be printing to it.
std::FILE* nowhere() {
  static std::FILE* const file = std::fopen("/dev/null", "we");
  return file;
}

}  // namespace

// The GNU C library's stderr is a variable that programs may set.
QuietStderr::QuietStderr() {
  const std::scoped_lock lock(mutex);
  if (count++ > 0) return;
  own = stderr;
  if (nowhere()) stderr = nowhere();
}

QuietStderr::~QuietStderr() {
  const std::scoped_lock lock(mutex);
  if (--count == 0) stderr = own;
}

}  // namespace gramloom
