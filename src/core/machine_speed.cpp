#include "core/machine_speed.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "core/image.h"
#include "core/random.h"
#include "core/threads.h"

namespace gramloom {

namespace {

// Of the machine that Cost's figures were measured on.
constexpr double reference_comparisons = 1.0e7;  // a second, of one thread

constexpr int side = 512, patch = 7;
constexpr std::int64_t comparisons_at_once = 1 << 16, repeats = 5;

Image grain() {
  Image image({side, side}, 3);
  Random random(1);
  for (float& value : image.pixels) value = random.uniform();
  return image;
}

// The squared difference of two patches at places that differ from one number to the next.
float compare(const Image& image, std::uint32_t number) {
  const auto place = [](std::uint32_t bits) { return static_cast<int>(bits % (side - patch)); };
  const std::uint32_t first = number * 2654435761u, second = number * 2246822519u;
  float sum = 0;
  for (int y = 0; y < patch; ++y) {
    const float* a = image.at(place(first >> 16), place(first & 0xffff) + y);
    const float* b = image.at(place(second >> 16), place(second & 0xffff) + y);
    for (int i = 0; i < 3 * patch; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return sum;
}

// Comparisons a second in `threads` threads, the best of some tries: what else runs only slows
// them.
double comparisons_per_second(const Image& image, int threads) {
  double best = 0;
  std::atomic<float> sink = 0;
  for (std::int64_t repeat = 0; repeat < repeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    parallel_for(threads, 1, [&](std::int64_t begin, std::int64_t end) {
      float sum = 0;
      for (std::int64_t i = begin * comparisons_at_once; i < end * comparisons_at_once; ++i)
        sum += compare(image, static_cast<std::uint32_t>(i));
      sink = sum;
    });
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    best = std::max(best, static_cast<double>(comparisons_at_once) * threads / time.count());
  }
  return best;
}

}  // namespace

Speed measure_speed() {
  const Image image = grain();
  Speed speed;
  speed.serial = comparisons_per_second(image, 1) / reference_comparisons;
  speed.shared = comparisons_per_second(image, thread_count()) / reference_comparisons;
  return speed;
}

}  // namespace gramloom
