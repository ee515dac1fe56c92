#include "classic/quilt_labels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/threads.h"
#include "signal/squared_distance.h"
#include "signal/united.h"

namespace gramloom {

namespace {

constexpr std::size_t most_labels = 64;
/// Smaller patches would hold nothing of a texture.
constexpr int smallest_patch = 6;
/// A guide counts as missed by as much more than the best as pixels differ that have nothing in
/// common, in terms of the variance.
constexpr float plain = 2;

struct Label {
  std::vector<float> value;
  std::vector<Source> pixels;  // of the exemplar, those that may be used
};

/// The values of the exemplar's guide; none where there are many.
std::vector<Label> find_labels(const Exemplar& exemplar) {
  std::map<std::vector<float>, std::vector<Source>> found;
  for (int y = 0; y < exemplar.guide.height; ++y)
    for (int x = 0; x < exemplar.guide.width; ++x) {
      if (!exemplar.mask.empty() && *exemplar.mask.at(x, y) < 0.5f) continue;
      const float* value = exemplar.guide.at(x, y);
      found[{value, value + exemplar.guide.channels}].push_back({x, y});
      if (found.size() > most_labels) return {};
    }
  std::vector<Label> labels;
  for (auto& [value, pixels] : found) labels.push_back({value, std::move(pixels)});
  return labels;
}

/// For each pixel that may be made and whose label is plainly not the best one: the best one's
/// index; else −1.
std::vector<int> find_missed(const Quilt& quilt, const QuiltLabels& target,
                             const std::vector<Label>& labels, const Image& mask) {
  const Size size = quilt.canvas.size();
  std::vector<int> missed(to_size(size.width) * to_size(size.height), -1);
  parallel_for(size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (auto y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < size.width; ++x) {
        if (!mask.empty() && *mask.at(x, y) < 0.5f) continue;
        const float* wanted = target.guide.at(x, y);
        const std::size_t channels = to_size(target.guide.channels);
        const float weight = target.weight.empty() ? 1 : *map_at(target.weight, x, y);
        const Source from = *quilt.source.at(x, y);
        const float has = squared_distance(
            wanted, target.exemplar.guide.at(static_cast<int>(from.x), static_cast<int>(from.y)),
            channels);
        if (weight * weight * has <= plain) continue;
        float least = INFINITY;
        std::size_t best = 0;
        for (std::size_t i = 0; i < labels.size(); ++i) {
          const float distance = squared_distance(wanted, labels[i].value.data(), channels);
          if (distance < least) {
            least = distance;
            best = i;
          }
        }
        if (weight * weight * (has - least) > plain)
          missed[to_size(y) * to_size(size.width) + to_size(x)] = static_cast<int>(best);
      }
  });
  return missed;
}

std::vector<Ground> ground_of(const std::vector<int>& missed) {
  std::vector<Ground> ground(missed.size());
  std::ranges::transform(missed, ground.begin(),
                         [](int m) { return m >= 0 ? Ground::bare : Ground::firm; });
  return ground;
}

bool in_rows(Source a, Source b) { return a.y != b.y ? a.y < b.y : a.x < b.x; }

/// A pixel of the label: of several drawn at random, and those that continue the pixels beside it,
/// the one that is most like these.
Source find_pixel(const Quilt& quilt, const Exemplar& exemplar, const Label& label, int x, int y,
                  Random random) {
  constexpr int tries = 32;
  std::vector<const float*> beside;
  std::vector<Source> candidates;
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {0, -1}, {1, 0}, {0, 1}}) {
    const int at_x = x + dx, at_y = y + dy;
    if (at_x < 0 || at_y < 0 || at_x >= quilt.canvas.width || at_y >= quilt.canvas.height) continue;
    const Source there = *quilt.source.at(at_x, at_y);
    const int from_x = static_cast<int>(there.x), from_y = static_cast<int>(there.y);
    if (squared_distance(exemplar.guide.at(from_x, from_y), label.value.data(),
                         to_size(exemplar.guide.channels)) > 0)
      continue;
    beside.push_back(quilt.canvas.at(at_x, at_y));
    const Source next(from_x - dx, from_y - dy);
    if (std::ranges::binary_search(label.pixels, next, in_rows)) candidates.push_back(next);
  }
  for (int i = 0; i < tries; ++i)
    candidates.push_back(
        label.pixels[random.below(static_cast<std::uint32_t>(label.pixels.size()))]);
  return *std::ranges::min_element(candidates, {}, [&](Source s) {
    float sum = 0;
    const float* pixel = exemplar.image.at(static_cast<int>(s.x), static_cast<int>(s.y));
    for (const float* other : beside)
      sum += squared_distance(pixel, other, to_size(exemplar.image.channels));
    return sum;
  });
}

}  // namespace

void keep_labels(Quilt& quilt, const QuiltLabels& target, const Image& mask, Size patch,
                 double overlap, const QuiltRules& rules, Random random,
                 const QuiltReport& report) {
  const std::vector<Label> labels = find_labels(target.exemplar);
  if (labels.empty()) return;
  const Size size = quilt.canvas.size();
  std::vector<int> missed = find_missed(quilt, target, labels, mask);
  const auto any = [&] { return std::ranges::any_of(missed, [](int m) { return m >= 0; }); };
  std::uint64_t round = 0;
  for (int side = std::min(patch.width, patch.height) / 2; side >= smallest_patch && any();
       side /= 2) {
    const auto axis = [&](int length, bool wraps) {
      return cover(length, side, static_cast<int>(overlap * side), wraps);
    };
    const PatchAxis x = axis(size.width, tiles_x(target.tile));
    const PatchAxis y = axis(size.height, tiles_y(target.tile));
    const QuiltDirection direction(target.exemplar, target.guide, target.weight,
                                   {x.patch, y.patch});
    QuiltRules own = rules;
    own.feather = 0;
    fill_quilt(quilt, ground_of(missed), {target.exemplar.image, &direction, nullptr}, x, y, own,
               random.stream(round++), report);
    missed = find_missed(quilt, target, labels, mask);
  }
  for (std::size_t i = 0; i < missed.size(); ++i) {
    if (missed[i] < 0) continue;
    const int x = static_cast<int>(i) % size.width, y = static_cast<int>(i) / size.width;
    const Source from = find_pixel(quilt, target.exemplar, labels[to_size(missed[i])], x, y,
                                   random.stream(1000 + i));
    *quilt.source.at(x, y) = from;
    std::copy_n(target.exemplar.image.at(static_cast<int>(from.x), static_cast<int>(from.y)),
                quilt.canvas.channels, quilt.canvas.at(x, y));
  }
}

}  // namespace gramloom
