#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace gramloom {

/// Threads that help their caller with one piece of work at a time. They are made when first
/// needed and stay; between two pieces they sleep, after a wait of some microseconds for the next.
///
/// A helper joins when it gets a core, and its caller waits only for those that have joined. So
/// work gets done by however few threads there are: where the system refuses to make more, in a
/// child of fork() that has none, or while other programs keep the cores busy.
class ThreadPool {
 public:
  /// Calls `work` in this thread and in up to `helpers` others at the same time; back when all
  /// have returned. `work` must not throw. Work that is inside other work, or meets that of
  /// another thread, is called in this thread alone.
  void run(int helpers, const std::function<void()>& work);

 private:
  void make_helpers(int wanted);
  void help();

  std::mutex one_at_a_time_, mutex_;
  const std::function<void()>* work_ = nullptr;
  int places_ = 0;  // for helpers that may still join
  int helpers_ = 0;
  bool refused_ = false;        // the system lets us have no more
  std::atomic<int> pieces_{0};  // of work so far, for those that wait for the next
  std::atomic<int> joined_{0};  // helpers at work
};

}  // namespace gramloom
