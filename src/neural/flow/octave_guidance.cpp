#include "neural/flow/octave_guidance.h"

#include <algorithm>
#include <cmath>

#include "neural/flow/memory.h"
#include "neural/loss/directed_places.h"
#include "neural/quarter_means.h"

namespace gramloom::neural {

namespace {

std::size_t index_of(PatchPlace p, int width) {
  return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(p.x);
}

std::size_t pixels_of(Size size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

std::vector<float> confidences(const Image& made, int side) {
  constexpr float base = 1.3f;
  constexpr int most_steps = 12;
  const std::vector<int> steps = steps_to_known(made);
  std::vector<float> result(steps.size());
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x) {
      const auto middle = made.index((x + side / 2) % made.width, (y + side / 2) % made.height);
      result[made.index(x, y)] =
          std::pow(base, -static_cast<float>(std::min(steps[middle], most_steps)));
    }
  return result;
}

class GuideAgreement {
 public:
  explicit GuideAgreement(const Guidance& guidance) : guidance_(guidance) {}

  float operator()(int x, int y, int u, int v) const {
    constexpr float sharpness = 0.5f, least = 1e-3f;
    const float *wanted = guidance_.guide.at(x, y), *own = guidance_.exemplar_guide.at(u, v);
    const float weight = *guidance_.guide_weight.at(x, y);
    float distance = 0;
    for (int c = 0; c < guidance_.guide.channels; ++c)
      distance += (wanted[c] - own[c]) * (wanted[c] - own[c]);
    return least + std::exp(-sharpness * weight * weight * distance);
  }

 private:
  const Guidance& guidance_;
};

}  // namespace

OctaveGuidance::OctaveGuidance(const Guidance& finest, Size exemplar, Size picture, int side)
    : guidance_(with_shares_as_guide(scaled(finest, exemplar, picture))),
      side_(side),
      places_(patch_places(exemplar, side)),
      picture_(picture),
      guided_(guidance_, side, 1) {
  for (const auto& of_exemplar : usable_places(guidance_, exemplar, side))
    usable_.insert(usable_.end(), of_exemplar.begin(), of_exemplar.end());
  is_usable_.resize(pixels_of(places_));
  for (const PatchPlace p : usable_) is_usable_[index_of(p, places_.width)] = 1;
  if (guides()) {
    const Image means = quarter_means(guidance_.exemplar_guide, side);
    GuideRows rows{means.channels, {}};
    for (const PatchPlace p : usable_)
      rows.values.insert(rows.values.end(), means.at(p.x, p.y),
                         means.at(p.x, p.y) + means.channels);
    like_guides_ = group_guides(rows, 64);
  }
  if (fills()) {
    confidence_ = confidences(guidance_.made, side);
    counts_.resize(pixels_of(picture));
    for (const PatchPlace p : made_places(guidance_, picture, side))
      counts_[index_of(p, picture.width)] = 1;
  }
  find_regions(exemplar, picture);
}

void OctaveGuidance::find_regions(Size exemplar, Size picture) {
  constexpr std::size_t most_regions = 32;
  const Guidance& g = guidance_;
  GuideGroups groups;
  if (guides()) {
    groups = group_guides({g.guide.channels, usable_pixels(g.exemplar_guide, g.usable).pixels},
                          most_regions);
    exemplar_regions_.count = regions_.count = static_cast<int>(groups.middle.count());
  }
  // Where `counts` is not 0, the group whose guide is the nearest, or the one that there is.
  const auto find = [&](const Image& counts, const Image& guide, Size size) {
    std::vector<std::int32_t> regions;
    for (std::size_t i = 0; i < pixels_of(size); ++i) {
      const bool is_counted = counts.empty() || counts.pixels[i] > 0.5f;
      const auto first = i * static_cast<std::size_t>(guide.channels);
      regions.push_back(!is_counted ? -1
                        : guides()  ? groups.nearest(guide.pixels.data() + first)
                                    : 0);
    }
    return regions;
  };
  if (guides() || !g.usable.empty())
    exemplar_regions_.region = find(g.usable, g.exemplar_guide, exemplar);
  if (guides() || fills()) regions_.region = find(g.made, g.guide, picture);
}

bool OctaveGuidance::is_usable(PatchPlace place) const {
  return is_usable_[index_of(place, places_.width)] != 0;
}

std::vector<PatchPlace> OctaveGuidance::queries(int shift_x, int shift_y) const {
  // Where patches end at an edge, pixels at it lie in none that begins elsewhere.
  const auto is_one = [&](int at, int shift, int side, bool wraps) {
    return at % patch_stride == shift || (!wraps && (at == 0 || at == side - side_));
  };
  std::vector<PatchPlace> queries;
  for (int y = 0; y < picture_.height; ++y) {
    if (!is_one(y, shift_y, picture_.height, tiles_y(guidance_.tile))) continue;
    for (int x = 0; x < picture_.width; ++x)
      if (counts_[index_of({x, y}, picture_.width)] != 0 &&
          is_one(x, shift_x, picture_.width, tiles_x(guidance_.tile)))
        queries.push_back({x, y});
  }
  return queries;
}

void OctaveGuidance::add_confidence(const std::vector<PatchPlace>& queries,
                                    std::vector<float>& weights) const {
  const std::size_t neighbours = queries.empty() ? 0 : weights.size() / queries.size();
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] *= confidence_[index_of(queries[i / neighbours], picture_.width)];
}

Agreement OctaveGuidance::agreement() const {
  if (guides()) return GuideAgreement(guidance_);
  if (fills()) return [](int, int, int, int) { return 1.0f; };
  return {};
}

void OctaveGuidance::level(Prices prices) const {
  const auto count = static_cast<std::size_t>(like_guides_.middle.count());
  std::vector<double> sums(count), numbers(count);
  const auto price = [&](PatchPlace p) -> float& {
    return prices.values[index_of(p, prices.places.width)];
  };
  for (std::size_t i = 0; i < usable_.size(); ++i) {
    const auto group = static_cast<std::size_t>(like_guides_.group[i]);
    sums[group] += price(usable_[i]);
    ++numbers[group];
  }
  for (std::size_t i = 0; i < usable_.size(); ++i) {
    const auto group = static_cast<std::size_t>(like_guides_.group[i]);
    price(usable_[i]) -= static_cast<float>(sums[group] / numbers[group]);
  }
}

}  // namespace gramloom::neural
