#include "core/fields.h"

#include <algorithm>
#include <numeric>

namespace gramloom {

namespace {

// Number of inserted, deleted, changed or swapped letters between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min(
          {d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string number(double value, bool integer) {
  return integer ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

}  // namespace

std::string describe(const Range& range, bool integer) {
  const double lowest = -std::numeric_limits<double>::max();
  const double highest = std::numeric_limits<double>::max();
  if (range.min > lowest && range.max < highest)
    return number(range.min, integer) + " to " + number(range.max, integer);
  if (range.min > lowest) return "at least " + number(range.min, integer);
  if (range.max < highest) return "at most " + number(range.max, integer);
  return integer ? "any whole number" : "any number";
}

std::string closest_word(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : words)
    if (const std::size_t distance = edit_distance(word, candidate); distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  return best;
}

void detail::check_number(const FieldText& field, double value, bool integer) {
  if (!field.range.contains(value))
    throw ConfigError("{} = {}: allowed are {}", field.name, value, describe(field.range, integer));
}

}  // namespace gramloom
