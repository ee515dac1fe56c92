#pragma once

#include <chrono>
#include <thread>

namespace gramloom {

/// Between two looks at what nothing tells us of.
inline constexpr std::chrono::milliseconds polling_pause{20};

/// Looks again and again until the condition holds or so much time is over; whether it holds.
template <class Condition>
bool comes_true(std::chrono::steady_clock::duration patience, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(polling_pause);
  }
  return true;
}

}  // namespace gramloom
