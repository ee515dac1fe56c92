#include "core/histogram_match.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/threads.h"

namespace gramloom {

namespace {

/// Unsigned integers in the order of the floats; −0 joins 0.
std::uint32_t to_key(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

float to_value(std::uint32_t key) {
  return std::bit_cast<float>(key & 0x80000000u ? key & 0x7FFFFFFFu : ~key);
}

// A radix sort from the lowest digit on is stable and takes three passes over 32-bit keys: several
// times faster than comparing. An item keeps its key in the low 32 bits.
constexpr int digit_bits = 11;
constexpr int passes = 3;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

template <class Item>
std::size_t digit_of(Item item, int pass) {
  return static_cast<std::size_t>(item >> (pass * digit_bits)) &
         ((pass == passes - 1 ? std::size_t{1} << (32 - 2 * digit_bits) : digits) - 1);
}

template <class Item>
void radix_sort(std::vector<Item>& items) {
  std::array<std::array<std::size_t, digits>, passes> place{};
  for (const Item item : items)
    for (int pass = 0; pass < passes; ++pass)
      ++place[static_cast<std::size_t>(pass)][digit_of(item, pass)];
  std::vector<Item> other(items.size());
  for (int pass = 0; pass < passes; ++pass) {
    auto& next = place[static_cast<std::size_t>(pass)];
    std::size_t start = 0;
    for (auto& n : next) start += std::exchange(n, start);
    for (const Item item : items) other[next[digit_of(item, pass)]++] = item;
    items.swap(other);
  }
}

/// Position of each rank's value, and the weight of its successor, in the exemplar's sorted values.
class Quantiles {
 public:
  Quantiles(std::span<const float> sorted, std::size_t ranks)
      : sorted_(sorted),
        step_(static_cast<double>(sorted.size()) / static_cast<double>(ranks)),
        same_(sorted.size() == ranks) {}

  float operator()(std::size_t rank) const {
    if (same_) return sorted_[rank];
    const double last = static_cast<double>(sorted_.size() - 1);
    const double position = std::clamp((static_cast<double>(rank) + 0.5) * step_ - 0.5, 0.0, last);
    const auto below = static_cast<std::size_t>(position);
    const auto above = std::min(below + 1, sorted_.size() - 1);
    const double weight = position - static_cast<double>(below);
    return static_cast<float>((1 - weight) * static_cast<double>(sorted_[below]) +
                              weight * static_cast<double>(sorted_[above]));
  }

 private:
  std::span<const float> sorted_;
  double step_;
  bool same_;
};

std::vector<float> channel_values(const Image& image, int channel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<float> values(image.pixels.size() / channels);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = image.pixels[i * channels + static_cast<std::size_t>(channel)];
  return values;
}

}  // namespace

std::vector<float> sorted_values(std::span<const float> values) {
  std::vector<std::uint32_t> keys(values.size());
  std::transform(values.begin(), values.end(), keys.begin(), to_key);
  radix_sort(keys);
  std::vector<float> sorted(keys.size());
  std::transform(keys.begin(), keys.end(), sorted.begin(), to_value);
  return sorted;
}

void match_values(std::span<float> values, std::span<const float> sorted) {
  if (sorted.empty()) throw Error("a histogram of no values cannot be matched");
  if (values.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error("{} values are too many to match their histogram", values.size());
  std::vector<std::uint64_t> items(values.size());  // (place, key)
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i] = (std::uint64_t{i} << 32) | to_key(values[i]);
  radix_sort(items);
  const Quantiles quantile(sorted, items.size());
  for (std::size_t rank = 0; rank < items.size(); ++rank)
    values[static_cast<std::size_t>(items[rank] >> 32)] = quantile(rank);
}

void match_histogram(Image& image, const Image& exemplar) {
  if (image.channels != exemplar.channels)
    throw Error("an image of {} channels cannot get the histograms of {} channels", image.channels,
                exemplar.channels);
  const auto channels = static_cast<std::size_t>(image.channels);
  parallel_for(image.channels, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<int>(begin); c < end; ++c) {
      auto values = channel_values(image, c);
      match_values(values, sorted_values(channel_values(exemplar, c)));
      for (std::size_t i = 0; i < values.size(); ++i)
        image.pixels[i * channels + static_cast<std::size_t>(c)] = values[i];
    }
  });
}

}  // namespace gramloom
