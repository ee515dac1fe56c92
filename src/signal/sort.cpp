#include "signal/sort.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/error.h"

namespace gramloom {

namespace {

constexpr int digit_bits = 11;
constexpr int all_digits = 3;  // of 32 bits
constexpr std::uint32_t digit_values = 1u << digit_bits;

// Items that, together with a second copy, stay in the cache. Of more, dealing them out by digits
// from the lowest on would miss it each time (15 ns an item instead of 4).
constexpr std::size_t most_in_cache = std::size_t{1} << 18;
constexpr std::size_t few =
    digit_values / 4;  // for which counting digits costs more than comparing

std::uint32_t key_of(std::uint32_t key) { return key; }
std::uint32_t key_of(const RankedValue& item) { return item.key; }

std::uint32_t digit(std::uint32_t key, int number) {
  return key >> (digit_bits * number) & (digit_values - 1);
}

using Counts = std::array<std::uint32_t, digit_values>;

// Counts become the place of each digit's first item.
void to_places(Counts& counts) {
  std::uint32_t sum = 0;
  for (auto& count : counts) sum += std::exchange(count, sum);
}

// Sorts by the lowest `digits` digits, dealing from one copy to the other; the result is in the one
// that it returns.
template <class Item>
std::span<Item> sort_by_digits(std::span<Item> items, std::span<Item> other, int digits) {
  std::array<Counts, all_digits> place{};
  for (const Item& item : items)
    for (int d = 0; d < digits; ++d) ++place[static_cast<std::size_t>(d)][digit(key_of(item), d)];
  for (int d = 0; d < digits; ++d) {
    Counts& next = place[static_cast<std::size_t>(d)];
    to_places(next);
    for (const Item& item : items) other[next[digit(key_of(item), d)]++] = item;
    std::swap(items, other);
  }
  return items;
}

void sort_few(std::span<std::uint32_t> keys) { std::sort(keys.begin(), keys.end()); }
void sort_few(std::span<RankedValue> items) {
  std::sort(items.begin(), items.end(), [](const RankedValue& a, const RankedValue& b) {
    return std::pair(a.key, a.place) < std::pair(b.key, b.place);
  });
}

// make(place, key(value)) for each of the values, in the order of the keys.
template <class Item, class Key, class Make>
std::span<Item> sorted(std::span<const float> values, std::vector<Item>& items,
                       std::vector<Item>& other, const Key& key, const Make& make) {
  items.resize(values.size());
  if (values.size() <= most_in_cache) {
    other.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      items[i] = make(static_cast<std::uint32_t>(i), key(values[i]));
    return sort_by_digits(std::span(items), std::span(other), all_digits);
  }
  // First by the highest digit, then what shares it by the others: each in the cache, and without a
  // second copy of all.
  constexpr int highest = all_digits - 1;
  Counts next{};
  for (const float value : values) ++next[digit(key(value), highest)];
  to_places(next);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t own = key(values[i]);
    items[next[digit(own, highest)]++] = make(static_cast<std::uint32_t>(i), own);
  }
  std::size_t begin = 0;
  for (const std::size_t end : next) {  // where the items of a digit end
    const std::span<Item> bucket(items.data() + begin, end - begin);
    begin = end;
    if (bucket.size() <= few) {
      sort_few(bucket);
      continue;
    }
    static_assert(highest % 2 == 0);  // the items end where they began
    other.resize(std::max(other.size(), bucket.size()));
    sort_by_digits(bucket, std::span(other).first(bucket.size()), highest);
  }
  return items;
}

void check_count(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw Error("{} values are too many to sort", count);
}

}  // namespace

void Sorter::sort(std::span<float> values) {
  check_count(values.size());
  const auto keys = sorted(std::span<const float>(values), keys_, other_keys_, to_key,
                           [](std::uint32_t, std::uint32_t key) { return key; });
  std::transform(keys.begin(), keys.end(), values.begin(), to_value);
}

std::span<const RankedValue> Sorter::rank(std::span<const float> values) {
  check_count(values.size());
  return sorted(
      values, ranked_, other_ranked_,
      [](float value) { return to_key(value + 0.0f); },  // −0 becomes 0
      [](std::uint32_t place, std::uint32_t key) {
        return RankedValue{key, place};
      });
}

}  // namespace gramloom
