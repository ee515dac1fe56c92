#include "signal/histogram_match.h"

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

// A stable radix sort takes three passes over 32-bit keys: several times faster than comparing. An
// item keeps its key in the low 32 bits. The first pass deals the values into buckets by the
// highest digit; the others sort one bucket after another, from the lowest digit on, so that there
// is no second copy of all items.
constexpr int digit_bits = 11;
constexpr int low_passes = 2;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

std::size_t high_digit(std::uint32_t key) { return key >> (low_passes * digit_bits); }

template <class Item>
std::size_t low_digit(Item item, int pass) {
  return static_cast<std::size_t>(item >> (pass * digit_bits)) & (digits - 1);
}

template <class Item>
void sort_bucket(std::span<Item> items, std::vector<Item>& other) {
  std::array<std::array<std::size_t, digits>, low_passes> place{};
  for (const Item item : items)
    for (int pass = 0; pass < low_passes; ++pass)
      ++place[static_cast<std::size_t>(pass)][low_digit(item, pass)];
  other.resize(std::max(other.size(), items.size()));
  static_assert(low_passes % 2 == 0);  // the items end where they began
  Item *from = items.data(), *to = other.data();
  for (auto& next : place) {
    const auto pass = static_cast<int>(&next - place.data());
    std::size_t start = 0;
    for (auto& n : next) start += std::exchange(n, start);
    for (std::size_t i = 0; i < items.size(); ++i) to[next[low_digit(from[i], pass)]++] = from[i];
    std::swap(from, to);
  }
}

/// make(i, key) for the i-th of the values, in the order of the keys.
template <class Item, class Make>
std::vector<Item> sorted_items(std::span<const float> values, const Make& make) {
  std::array<std::size_t, digits> next{};
  for (const float value : values) ++next[high_digit(to_key(value))];
  std::size_t start = 0;
  for (auto& n : next) start += std::exchange(n, start);
  std::vector<Item> items(values.size()), other;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t key = to_key(values[i]);
    items[next[high_digit(key)]++] = make(i, key);
  }
  constexpr auto by_key = [](Item a, Item b) {
    return static_cast<std::uint32_t>(a) < static_cast<std::uint32_t>(b);
  };
  std::size_t begin = 0;
  for (const std::size_t end : next) {  // where the bucket ended
    const std::span bucket(items.data() + begin, end - begin);
    if (bucket.size() > digits / 4)
      sort_bucket(bucket, other);
    else
      std::stable_sort(bucket.begin(), bucket.end(), by_key);
    begin = end;
  }
  return items;
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
  const auto keys =
      sorted_items<std::uint32_t>(values, [](std::size_t, std::uint32_t key) { return key; });
  std::vector<float> sorted(keys.size());
  std::transform(keys.begin(), keys.end(), sorted.begin(), to_value);
  return sorted;
}

void match_values(std::span<float> values, std::span<const float> sorted) {
  if (sorted.empty()) throw Error("a histogram of no values cannot be matched");
  if (values.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error("{} values are too many to match their histogram", values.size());
  const auto items = sorted_items<std::uint64_t>(values, [](std::size_t i, std::uint32_t key) {
    return std::uint64_t{i} << 32 | key;  // (place, key)
  });
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
