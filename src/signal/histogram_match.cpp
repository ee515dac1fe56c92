#include "signal/histogram_match.h"

#include <algorithm>

#include "core/error.h"
#include "core/threads.h"
#include "signal/quantile.h"
#include "signal/sort.h"

namespace gramloom {

namespace {

std::vector<float> channel_values(const Image& image, int channel) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<float> values(image.pixels.size() / channels);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = image.pixels[i * channels + static_cast<std::size_t>(channel)];
  return values;
}

}  // namespace

std::vector<float> sorted_values(std::span<const float> values) {
  std::vector<float> sorted(values.begin(), values.end());
  for (float& value : sorted) value += 0.0f;  // −0 becomes 0
  Sorter().sort(sorted);
  return sorted;
}

void match_values(std::span<float> values, std::span<const float> sorted) {
  if (sorted.empty()) throw Error("a histogram of no values cannot be matched");
  Sorter sorter;
  const auto ranked = sorter.rank(values);
  const Quantiles quantile(sorted, ranked.size());
  for (std::size_t rank = 0; rank < ranked.size(); ++rank)
    values[ranked[rank].place] = static_cast<float>(quantile(rank));
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
