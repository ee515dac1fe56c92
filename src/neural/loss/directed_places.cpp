#include "neural/loss/directed_places.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "neural/directed_settings.h"
#include "neural/flow/guided_patches.h"
#include "neural/flow/nearest.h"
#include "neural/picture.h"
#include "neural/quarter_means.h"

namespace gramloom::neural {

namespace {

// Where patches of a result may begin.
Size places_of(Size result, int side, Tile wraps) {
  return {tiles_x(wraps) ? result.width : result.width - side + 1,
          tiles_y(wraps) ? result.height : result.height - side + 1};
}

// Which exemplar a patch is of: the one that the pixel in its middle is of.
std::size_t member_of(const Image& member, PatchPlace place, int side) {
  const float* values = member.at(place.x + side / 2, place.y + side / 2);
  return static_cast<std::size_t>(std::max_element(values, values + member.channels) - values);
}

GuideRows rows_at(const Image& image, const std::vector<PatchPlace>& places, int offset) {
  GuideRows rows{image.channels, {}};
  for (const PatchPlace p : places) {
    const float* values = image.at((p.x + offset) % image.width, (p.y + offset) % image.height);
    rows.values.insert(rows.values.end(), values, values + image.channels);
  }
  return rows;
}

// Leaves out patches that are unlike all of the exemplar's, but for those with a pixel that no
// other patch would hold.
void leave_out_unlike(const std::vector<GuideDraws>& draws, Size result, int side,
                      std::vector<PatchPlace>& counted, std::vector<std::int64_t>& kept) {
  constexpr float too_unlike = 1;
  Image holds(result, 1);
  const auto for_each_pixel = [&](PatchPlace p, auto&& f) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        f(*holds.at((p.x + x) % result.width, (p.y + y) % result.height));
  };
  const auto is_unlike = [&](std::size_t i) {
    return std::ranges::all_of(draws, [&](const GuideDraws& of_exemplar) {
      return of_exemplar.unlike(static_cast<std::int64_t>(i)) > too_unlike;
    });
  };
  std::vector<unsigned char> unlike(counted.size());
  for (std::size_t i = 0; i < counted.size(); ++i) {
    unlike[i] = is_unlike(i) ? 1 : 0;
    if (unlike[i] == 0) for_each_pixel(counted[i], [](float& held) { held = 1; });
  }
  std::vector<PatchPlace> result_places;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    bool needed = unlike[i] == 0;
    if (!needed) for_each_pixel(counted[i], [&](float& held) { needed |= held == 0; });
    if (!needed) continue;
    result_places.push_back(counted[i]);
    kept.push_back(static_cast<std::int64_t>(i));
  }
  counted = std::move(result_places);
}

}  // namespace

std::vector<std::vector<PatchPlace>> usable_places(const Guidance& guidance, Size exemplar,
                                                   int side) {
  const auto usable = usable_origins(guidance.usable, exemplar, {side, side});
  const Size places = patch_places(exemplar, side);
  std::vector<std::vector<PatchPlace>> result(
      guidance.mixes() ? static_cast<std::size_t>(guidance.member.channels) : 1);
  std::size_t i = 0;
  for (int y = 0; y < places.height; ++y)
    for (int x = 0; x < places.width; ++x, ++i)
      if (usable[i] != 0)
        result[guidance.mixes() ? member_of(guidance.member, {x, y}, side) : 0].push_back({x, y});
  for (const auto& of_exemplar : result)
    if (of_exemplar.empty())
      throw Error(
          "no patch of {0}×{0} lies wholly in what may be used of {1}: make patch_sizes and "
          "flow_patch_sizes smaller, or the mask larger",
          side, guidance.mixes() ? "an exemplar" : "the exemplar");
  return result;
}

std::vector<PatchPlace> made_places(const Guidance& guidance, Size result, int side) {
  const Size places = places_of(result, side, guidance.tile);
  std::vector<PatchPlace> counted;
  Image made;
  if (guidance.fills()) made = patch_sums(guidance.made, side);
  for (int y = 0; y < places.height; ++y)
    for (int x = 0; x < places.width; ++x)
      if (!guidance.fills() || *made.at(x, y) > 0.5f) counted.push_back({x, y});
  return counted;
}

DirectedPlaces directed_places(const Guidance& guidance, Size exemplar, Size result, int side) {
  DirectedPlaces p;
  p.side = side;
  p.usable = usable_places(guidance, exemplar, side);
  p.counted = made_places(guidance, result, side);
  if (guidance.guides()) {
    const Image wanted_means = quarter_means(guidance.guide, side);
    const Image exemplar_means = quarter_means(guidance.exemplar_guide, side);
    const GuideRows wanted = rows_at(wanted_means, p.counted, 0);
    const GuideRows weights = rows_at(guidance.guide_weight, p.counted, side / 2);
    for (const auto& of_exemplar : p.usable)
      p.draws.emplace_back(rows_at(exemplar_means, of_exemplar, 0), wanted, weights.values);
    std::vector<std::int64_t> kept;
    leave_out_unlike(p.draws, result, side, p.counted, kept);
    for (GuideDraws& draws : p.draws) draws.keep(kept);
    p.tags = {guidance.guide.channels, {}};
    for (const std::int64_t i : kept)
      for (int c = 0; c < guidance.guide.channels; ++c) {
        float sum = 0;
        for (int quarter = 0; quarter < 4; ++quarter)
          sum += wanted.at(i)[quarter * guidance.guide.channels + c];
        p.tags.values.push_back(sum / 4 * *weights.at(i));
      }
  }
  if (guidance.mixes()) p.shares = rows_at(guidance.shares, p.counted, side / 2);
  return p;
}

at::Tensor nearest_places(const Guidance& guidance, const at::Tensor& exemplar,
                          const at::Tensor& picture, int side, Random random) {
  constexpr int axes_kept = 4;  // detail has no say: it is lost in a mean of patches
  const Image own = to_image(exemplar), result = to_image(picture);
  const auto usable = usable_places(guidance, own.size(), side);
  const auto counted = made_places(guidance, result.size(), side);
  const auto most_looked_at =
      static_cast<std::size_t>(looked_at_for_a_fill(std::ssize(counted) / 4));
  std::vector<PatchPlace> all;
  for (const auto& of_exemplar : usable)
    all.insert(all.end(), of_exemplar.begin(), of_exemplar.end());
  const PatchAxes axes = patch_axes(own, side, axes_kept, random.stream(0), all);
  const GuidedPatches guided(guidance, side, mean_square_of(own, guidance.usable));
  const Vectors queries = guided.queries(project(result, counted, axes), counted);
  at::Tensor found = at::empty({std::ssize(usable), std::ssize(counted), 2}, at::kFloat);
  float* to = found.data_ptr<float>();
  for (std::size_t e = 0; e < usable.size(); ++e) {
    const std::vector<PatchPlace> looked_at =
        some_of(usable[e], most_looked_at, random.stream(e + 1));
    const Vectors of_exemplar = project(own, looked_at, axes);
    const Neighbours nearest = nearest_references(
        queries, guided.references(of_exemplar, looked_at, 1), squares_of(of_exemplar), 1, 1);
    for (const std::int32_t r : nearest.reference) {
      const PatchPlace place = looked_at[static_cast<std::size_t>(r)];
      *to++ = static_cast<float>(place.x);
      *to++ = static_cast<float>(place.y);
    }
  }
  return found;
}

void take_nearest(const at::Tensor& nearest, const Guidance& guidance, Size result, int side,
                  DirectedPlaces& places) {
  const auto larger = made_places(guidance, result, side);
  std::vector<std::int32_t> index(
      static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height), -1);
  const auto at = [&](int x, int y) -> std::int32_t& {
    return index[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                 static_cast<std::size_t>(x)];
  };
  for (std::size_t i = 0; i < larger.size(); ++i)
    at(larger[i].x, larger[i].y) = static_cast<std::int32_t>(i);
  // Offsets of a smaller patch in a larger one, the middle first.
  const int room = side - places.side;
  std::vector<PatchPlace> offsets;
  for (int y = 0; y <= room; ++y)
    for (int x = 0; x <= room; ++x) offsets.push_back({x, y});
  std::ranges::stable_sort(offsets, {}, [&](PatchPlace o) {
    return std::abs(2 * o.x - room) + std::abs(2 * o.y - room);
  });
  const float* found = nearest.data_ptr<float>();
  const std::int64_t exemplars = nearest.size(0), count = nearest.size(1);
  places.nearest.assign(static_cast<std::size_t>(exemplars), {});
  std::vector<PatchPlace> counted;
  std::vector<std::int64_t> kept;
  for (std::size_t i = 0; i < places.counted.size(); ++i) {
    const PatchPlace p = places.counted[i];
    for (const PatchPlace o : offsets) {
      const int x = p.x - o.x, y = p.y - o.y;
      if ((x < 0 && !tiles_x(guidance.tile)) || (y < 0 && !tiles_y(guidance.tile))) continue;
      const std::int32_t l =
          at((x + result.width) % result.width, (y + result.height) % result.height);
      if (l < 0) continue;
      counted.push_back(p);
      kept.push_back(static_cast<std::int64_t>(i));
      for (std::int64_t e = 0; e < exemplars; ++e) {
        const float* from = found + (e * count + l) * 2;
        places.nearest[static_cast<std::size_t>(e)].push_back(
            {static_cast<int>(from[0]) + o.x, static_cast<int>(from[1]) + o.y});
      }
      break;
    }
  }
  places.counted = std::move(counted);
  for (GuideRows* rows : {&places.tags, &places.shares}) {
    GuideRows some{rows->length, {}};
    if (rows->length > 0)
      for (const std::int64_t i : kept)
        some.values.insert(some.values.end(), rows->at(i), rows->at(i) + rows->length);
    *rows = std::move(some);
  }
}

}  // namespace gramloom::neural
