#pragma once

#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

#include "neural/gloo_group.h"

namespace gramloom::neural {

/// Calls work(group) in so many threads, each as one of as many processes, and throws what one of
/// them throws.
inline void together(int size, const std::function<void(const Group&)>& work) {
  static int meetings = 0;
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     fmt::format("gramloom_group_{}_{}", getpid(), ++meetings);
  std::filesystem::remove(file);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank)
    threads.emplace_back([&, rank] {
      try {
        work(*join_group({rank, size, file.string(), std::chrono::seconds(60)}));
      } catch (...) {
        errors[static_cast<std::size_t>(rank)] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  std::filesystem::remove(file);
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace gramloom::neural
