#include "neural/guide_draws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/threads.h"

namespace gramloom::neural {

namespace {

constexpr float temperature = 0.02f;
constexpr std::size_t most_cells = 1024, most_groups = 2048;

float largest_of(const std::vector<float>& values) {
  float largest = 1e-6f;
  for (const float v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

// As group_guides(), with guides rounded to multiples of `step`; nothing for more than `most`.
bool group_by_step(const GuideRows& rows, float step, std::size_t most, GuideGroups& groups) {
  groups = {{}, {rows.length, {}}};
  groups.group.reserve(static_cast<std::size_t>(rows.count()));
  std::map<std::vector<std::int32_t>, std::int32_t> known;
  std::vector<std::int32_t> key(static_cast<std::size_t>(rows.length));
  for (std::int64_t i = 0; i < rows.count(); ++i) {
    for (std::size_t k = 0; k < key.size(); ++k)
      key[k] = static_cast<std::int32_t>(std::lround(rows.at(i)[k] / step));
    const auto [found, is_new] = known.try_emplace(key, static_cast<std::int32_t>(known.size()));
    if (is_new) {
      if (known.size() > most) return false;
      for (const std::int32_t k : key) groups.middle.values.push_back(static_cast<float>(k) * step);
    }
    groups.group.push_back(found->second);
  }
  return true;
}

}  // namespace

GuideGroups group_guides(const GuideRows& rows, std::size_t most) {
  GuideGroups groups;
  for (float step = largest_of(rows.values) / 64; !group_by_step(rows, step, most, groups);
       step *= 2) {
  }
  return groups;
}

std::int32_t GuideGroups::nearest(const float* guide) const {
  std::int32_t best = 0;
  float least = std::numeric_limits<float>::max();
  for (std::int64_t g = 0; g < middle.count(); ++g) {
    float distance = 0;
    for (std::int64_t k = 0; k < middle.length; ++k) {
      const float off = middle.at(g)[k] - guide[k];
      distance += off * off;
    }
    if (distance >= least) continue;
    least = distance;
    best = static_cast<std::int32_t>(g);
  }
  return best;
}

GuideDraws::GuideDraws(const GuideRows& exemplar, const GuideRows& wanted,
                       const std::vector<float>& weights) {
  GuideGroups own = group_guides(exemplar, most_cells);
  cells_.resize(static_cast<std::size_t>(own.middle.count()));
  for (std::size_t i = 0; i < own.group.size(); ++i)
    cells_[static_cast<std::size_t>(own.group[i])].push_back(static_cast<std::int32_t>(i));
  // The weight joins the guide, as one value more, as large as the largest of it.
  const float scale = largest_of(wanted.values) / largest_of(weights);
  GuideRows weighed{wanted.length + 1, {}};
  for (std::int64_t i = 0; i < wanted.count(); ++i) {
    weighed.values.insert(weighed.values.end(), wanted.at(i), wanted.at(i) + wanted.length);
    weighed.values.push_back(weights[static_cast<std::size_t>(i)] * scale);
  }
  GuideGroups groups = group_guides(weighed, most_groups);
  group_ = std::move(groups.group);
  const std::int64_t count = groups.middle.count();
  below_.resize(static_cast<std::size_t>(count));
  unlike_.resize(static_cast<std::size_t>(count));
  parallel_for(count, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t g = begin; g < end; ++g) {
      const float* goal = groups.middle.at(g);
      const float weight = goal[wanted.length] / scale;
      std::vector<float>& below = below_[static_cast<std::size_t>(g)];
      float least = std::numeric_limits<float>::max();
      for (std::int64_t c = 0; c < own.middle.count(); ++c) {
        float distance = 0;
        for (std::int64_t k = 0; k < wanted.length; ++k) {
          const float off = own.middle.at(c)[k] - goal[k];
          distance += off * off;
        }
        below.push_back(weight * weight * distance / 4);
        least = std::min(least, below.back());
      }
      double sum = 0;
      for (std::size_t c = 0; c < below.size(); ++c) {
        sum += static_cast<double>(std::exp((least - below[c]) / temperature)) *
               static_cast<double>(cells_[c].size());
        below[c] = static_cast<float>(sum);
      }
      for (float& b : below) b = static_cast<float>(b / sum);
      unlike_[static_cast<std::size_t>(g)] = least;
    }
  });
}

std::int64_t GuideDraws::draw(std::int64_t wanted, Random& random) const {
  const auto& below = below_[static_cast<std::size_t>(group_[static_cast<std::size_t>(wanted)])];
  const auto found = std::ranges::upper_bound(below, random.uniform()) - below.begin();
  const auto& cell = cells_[std::min(static_cast<std::size_t>(found), cells_.size() - 1)];
  return cell[random.below(static_cast<std::uint32_t>(cell.size()))];
}

float GuideDraws::unlike(std::int64_t wanted) const {
  return unlike_[static_cast<std::size_t>(group_[static_cast<std::size_t>(wanted)])];
}

void GuideDraws::keep(const std::vector<std::int64_t>& wanted) {
  std::vector<std::int32_t> kept;
  for (const std::int64_t i : wanted) kept.push_back(group_[static_cast<std::size_t>(i)]);
  group_ = std::move(kept);
}

}  // namespace gramloom::neural
