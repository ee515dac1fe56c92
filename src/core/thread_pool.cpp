#include "core/thread_pool.h"

#include <exception>
#include <thread>

#include "core/signals_blocked.h"

namespace gramloom {

namespace {

thread_local bool inside_work = false;

/// Turns of a wait before a thread sleeps: some ten microseconds, less than waking it costs.
constexpr int checks = 1000;

/// Back when `value` is not `old` any more.
void await_change(const std::atomic<int>& value, int old) {
  for (int i = 0; i < checks; ++i) {
    if (value != old) return;
#ifdef __x86_64__
    __builtin_ia32_pause();
#endif
  }
  value.wait(old);
}

}  // namespace

void ThreadPool::run(int helpers, const std::function<void()>& work) {
  std::unique_lock alone(one_at_a_time_, std::defer_lock);
  if (helpers <= 0 || inside_work || !alone.try_lock()) return work();
  {
    const std::lock_guard lock(mutex_);
    make_helpers(helpers);
    work_ = &work;
    places_ = helpers;
    ++pieces_;
  }
  pieces_.notify_all();
  inside_work = true;
  work();
  inside_work = false;
  {
    const std::lock_guard lock(mutex_);
    places_ = 0;
  }
  while (const int working = joined_) await_change(joined_, working);
}

void ThreadPool::make_helpers(int wanted) {
  if (helpers_ >= wanted || refused_) return;
  const SignalsBlocked blocked;
  try {
    for (; helpers_ < wanted; ++helpers_) std::thread([this] { help(); }).detach();
  } catch (const std::exception&) {  // no thread, or no memory for it
    refused_ = true;
  }
}

void ThreadPool::help() {
  inside_work = true;
  for (;;) {
    const int seen = pieces_;
    std::unique_lock lock(mutex_);
    if (places_ == 0) {
      lock.unlock();
      await_change(pieces_, seen);
      continue;
    }
    --places_;
    ++joined_;
    const std::function<void()>& work = *work_;
    lock.unlock();
    work();
    --joined_;
    joined_.notify_all();
  }
}

}  // namespace gramloom
