#include "classic/pixel_guide_cells.h"

#include <algorithm>
#include <cmath>

#include "core/threads.h"
#include "signal/squared_distance.h"

namespace gramloom::pixel {
namespace {

constexpr std::size_t most_cells = 64;

}  // namespace

GuideCells::GuideCells(const Level& level, Random random)
    : channels_(static_cast<std::size_t>(level.guide.channels)) {
  // Of some samples, each time the one that is furthest from all centres so far.
  std::vector<int> some;
  constexpr int most = 4096;
  for (int i = 0; i < std::min(most, level.count()); ++i) {
    const int sample =
        level.count() <= most
            ? i
            : static_cast<int>(random.below(static_cast<std::uint32_t>(level.count())));
    if (level.may_use(sample)) some.push_back(sample);
  }
  if (some.empty()) some.push_back(level.usable.front());
  const auto guide_of = [&](int sample) {
    return level.guide.pixels.data() + static_cast<std::size_t>(sample) * channels_;
  };
  std::vector<float> distance(some.size(), INFINITY);
  for (std::size_t next = 0; centres_.size() < most_cells * channels_ && distance[next] > 1e-6f;) {
    const float* centre = guide_of(some[next]);
    centres_.insert(centres_.end(), centre, centre + channels_);
    for (std::size_t i = 0; i < some.size(); ++i)
      distance[i] =
          std::min(distance[i], gramloom::squared_distance(guide_of(some[i]), centre, channels_));
    next = static_cast<std::size_t>(std::ranges::max_element(distance) - distance.begin());
  }
  std::vector<std::uint8_t> cell(static_cast<std::size_t>(level.count()));
  parallel_for(level.count(), 1024, [&](std::int64_t begin, std::int64_t end) {
    for (auto i = begin; i < end; ++i)
      cell[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(nearest(guide_of(static_cast<int>(i))));
  });
  members_.resize(centres_.size() / channels_);
  for (int i = 0; i < level.count(); ++i)
    if (level.may_use(i)) members_[cell[static_cast<std::size_t>(i)]].push_back(i);
}

std::size_t GuideCells::nearest(const float* guide) const {
  std::size_t best = 0;
  float least = INFINITY;
  for (std::size_t i = 0; i * channels_ < centres_.size(); ++i) {
    const float distance =
        gramloom::squared_distance(guide, centres_.data() + i * channels_, channels_);
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return best;
}

int GuideCells::draw(const float* guide, Random& random) const {
  const std::vector<int>& members = members_[nearest(guide)];
  return members[random.below(static_cast<std::uint32_t>(members.size()))];
}

}  // namespace gramloom::pixel
