#include "classic/patchmatch_directed.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "classic/patch_choice.h"
#include "classic/patch_features.h"
#include "classic/patch_growth.h"
#include "classic/patch_hole.h"
#include "classic/patch_levels.h"
#include "classic/patch_material.h"
#include "classic/patch_vote.h"
#include "classic/patch_windows.h"
#include "core/error.h"
#include "core/threads.h"
#include "signal/mirror.h"
#include "signal/patch_field.h"
#include "signal/share_labels.h"
#include "signal/united.h"

namespace gramloom {

namespace {

/// Where there are no known pixels, growth draws from the places that are this much worse than the
/// best.
constexpr float growth_tolerance = 0.1f;

/// In a fill what goes on must go on in phase: the first passes of a level also try all origins
/// this near, which coarser pixels could not tell apart, and all passes more random ones.
constexpr int near_passes = 2;
constexpr int near_radius = 2;
constexpr int more_tries = 3;

/// A target that a patch fits in: what is added is made, and cut off in the end.
Target padded(const Target& target, Size size) {
  const auto wider = [&](const Image& map) {
    if (map.empty()) return Image();  // not the map: GCC 14 warns of copying nothing
    Image result(size, map.channels);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        std::copy_n(map.at(std::min(x, map.width - 1), std::min(y, map.height - 1)), map.channels,
                    result.at(x, y));
    return result;
  };
  Target result{.size = size,
                .tile = target.tile,
                .known = wider(target.known),
                .mask = wider(target.mask),
                .guide = wider(target.guide),
                .guide_weight = target.guide_weight.size() == Size{1, 1}
                                    ? target.guide_weight
                                    : wider(target.guide_weight)};
  for (int y = 0; y < size.height && !result.mask.empty(); ++y)
    for (int x = 0; x < size.width; ++x)
      if (x >= target.size.width || y >= target.size.height) *result.mask.at(x, y) = 1;
  return result;
}

/// A window's part of a map of the target's size.
Image cut(const Image& map, const PatchWindow& window) {
  Image part(window.size, map.channels);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x)
      std::copy_n(map.at((window.left + x) % map.width, (window.top + y) % map.height),
                  map.channels, part.at(x, y));
  return part;
}

/// The features of a window's known pixels; what others have is not looked at.
Image known_features(const Target& target, const PatchWindow& window, const FeatureAxes& axes) {
  Image part = cut(target.known, window);
  for (std::size_t i = 0; i < window.states.size(); ++i)
    if (window.states[i] != PixelState::known)
      std::ranges::copy(axes.pca.mean, part.pixels.begin() +
                                           static_cast<std::ptrdiff_t>(i * axes.pca.mean.size()));
  return patch_features(part, axes);
}

PatchHole make_hole(PatchWindow window, const Target& target, const Image& guide,
                    const FeatureAxes& axes) {
  PatchHole hole;
  HoleLevel& finest = hole.levels.emplace_back();
  finest.size = window.size;
  if (!target.known.empty()) finest.known = known_features(target, window, axes);
  if (!guide.empty()) {
    finest.guide = guide_planes(cut(guide, window));
    finest.guide_weight = Image(window.size, 1, 1.0f);
    for (int y = 0; y < window.size.height && !target.guide_weight.empty(); ++y)
      for (int x = 0; x < window.size.width; ++x) {
        const float weight = *map_at(target.guide_weight, (window.left + x) % target.size.width,
                                     (window.top + y) % target.size.height);
        *finest.guide_weight.at(x, y) = weight * weight;
      }
  }
  finest.states = std::move(window.states);
  hole.window = std::move(window);
  make_pyramid(hole);
  return hole;
}

/// Calls f(hole, its number): large ones one after the other, small ones at the same time.
template <class F>
void for_each_hole(std::vector<PatchHole>& holes, std::size_t level, F&& f) {
  std::vector<std::size_t> small;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (holes[i].levels.size() <= level) continue;
    if (area(holes[i].levels[level].size) > 1 << 18 || holes.size() == 1)
      f(holes[i], i);
    else
      small.push_back(i);
  }
  parallel_for(std::ssize(small), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      f(holes[small[static_cast<std::size_t>(i)]], small[static_cast<std::size_t>(i)]);
  });
}

/// The patches that are looked for.
double count_patches(const PatchHole& hole) {
  if (hole.field.confidence.empty()) return area(hole.field.size);
  return static_cast<double>(
      std::ranges::count_if(hole.field.confidence, [](float c) { return c > 0; }));
}

/// A hole's first canvas and field on a level: grown on its coarsest, else those of the coarser
/// one.
void start(PatchHole& hole, std::size_t level, const PatchSource& source,
           const GrowthPlaces& places, Random random) {
  if (level + 1 < hole.levels.size()) {
    refine(hole, level, source);
    vote(hole.field, source.features, equal_weights, hole.canvas, hole.made);
    hole.levels.pop_back();
    return;
  }
  enter_level(hole, level);
  const bool fills = !hole.levels[level].known.empty();
  if (fills || !quilt(hole, level, source, random))
    grow(hole, places, fills ? 0 : growth_tolerance, random);
  if (count_patches(hole) * area(source.origins()) < 2e7)
    search_all(hole.field, hole.canvas, hole.guide, source, nullptr);
}

/// Writes where the hole's pixels came from.
void write_sources(const PatchHole& hole, const PatchSource& source, Size exemplar, Size target,
                   SourceMap& sources) {
  const std::vector<SmallOrigin> pixels = choose_pixels(hole, source);
  const Size part = texture_size(hole.field);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width) +
                                static_cast<std::size_t>(x);
      if (hole.made[pixel] == 0) continue;
      const int u = (hole.window.left + hole.left + x) % target.width;
      const int v = (hole.window.top + hole.top + y) % target.height;
      if (u >= sources.size.width || v >= sources.size.height) continue;
      const PatchOrigin from = pixels[pixel];
      *sources.at(u, v) = {mirrored(from.x, exemplar.width), mirrored(from.y, exemplar.height)};
    }
}

/// Makes the holes on all levels.
void optimise(const PatchmatchParams& params, PatchMaterial& material,
              std::vector<PatchHole>& holes, const Random& random, const Control& control) {
  const bool fills = !holes.front().levels.front().known.empty();
  std::size_t levels = 0;
  for (const PatchHole& hole : holes) levels = std::max(levels, hole.levels.size());
  material.levels.resize(levels);
  Progress progress;
  const auto iterations = [&](std::size_t level) {
    return params.iterations + more_iterations * static_cast<int>(level);
  };
  for (std::size_t level = 0; level < levels; ++level) progress.steps += iterations(level);
  for (std::size_t level = levels; level-- > 0;) {
    PatchSource& source = material.levels[level];
    prepare(source);
    GrowthPlaces places;
    if (std::ranges::any_of(holes,
                            [&](const PatchHole& h) { return h.levels.size() == level + 1; }))
      places = growth_places(source, static_cast<std::size_t>(few_origins));
    for_each_hole(holes, level, [&](PatchHole& hole, std::size_t i) {
      start(hole, level, source, places, random.stream(1).stream(i));
    });
    const double share = usable_share(source);
    std::optional<PatchPenalty> penalty;
    if (!fills ||
        (holes.size() == 1 && count_patches(holes.front()) > share * area(source.origins())))
      penalty.emplace(holes.front().field.size, source.origins());
    for (int i = 0; i < iterations(level); ++i) {
      const Random pass = random.stream(2).stream(static_cast<std::uint64_t>(progress.step));
      std::vector<double> energies(holes.size());
      for_each_hole(holes, level, [&](PatchHole& hole, std::size_t h) {
        if (fills && i < near_passes)
          search_near(hole.field, hole.canvas, hole.guide, source, near_radius);
        improve(hole.field, hole.canvas, hole.guide, source, penalty ? &*penalty : nullptr, i,
                params.tries + (fills ? more_tries : 0), pass.stream(h));
        energies[h] = robust_energy(hole.field, noise_floor);
        vote(hole.field, source.features, noise_floor, hole.canvas, hole.made);
      });
      if (penalty)
        update(*penalty, holes.front().field, params.uniformity, params.largest_copy, share);
      progress.loss = 0;
      for (const double energy : energies) progress.loss += energy;
      ++progress.step;
      if (!control.report(progress)) throw Interrupted();
    }
    if (level > 0) material.levels.pop_back();
  }
}

}  // namespace

bool is_directed(const RequestSize& request) {
  return request.exemplars.size() > 1 || request.exemplars.front().mask || request.guide ||
         request.known;
}

Texture directed_patchmatch(const PatchmatchParams& params, const Request& asked_for,
                            const Control& control) {
  const std::optional<Request> labelled = with_labels(asked_for);
  const Request& request = labelled ? *labelled : asked_for;
  const United united(request);
  const Size exemplar = united.exemplar().image.size();
  check_origins(exemplar);
  const Target& asked = request.target;
  const Size size{
      tiles_x(asked.tile) ? asked.size.width : std::max(asked.size.width, smallest_side),
      tiles_y(asked.tile) ? asked.size.height : std::max(asked.size.height, smallest_side)};
  const bool fits = size == asked.size;
  const bool fills = std::ranges::any_of(asked.mask.pixels, [](float v) { return v <= 0.5f; });
  Target changed;
  if (!fits) changed = padded(asked, size);
  if (fits && !fills) changed = asked;
  if (!fills) changed.known = changed.mask = {};
  const Target& target = fits && fills ? asked : changed;
  Image wider_guide;
  if (!fits) wider_guide = padded({.size = asked.size, .guide = united.guide()}, size).guide;
  const Image& guide = fits ? united.guide() : wider_guide;

  PatchMaterial material = make_material(params, target.known.empty() ? params.structure : 0,
                                         united, static_cast<int>(request.exemplars.size()), size);
  const auto levels = [&](int width) { return levels_for(material, width); };
  std::vector<PatchWindow> windows;
  if (target.known.empty())
    windows = {whole_window(size, target.tile, static_cast<int>(material.levels.size()))};
  else
    windows = windows_of(target.mask, target.tile, levels);
  std::vector<PatchHole> holes(windows.size());
  parallel_for(std::ssize(windows), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      holes[static_cast<std::size_t>(i)] =
          make_hole(std::move(windows[static_cast<std::size_t>(i)]), target, guide, material.axes);
  });
  optimise(params, material, holes, request.random, control);

  SourceMap sources(asked.size);
  for (PatchHole& hole : holes) {
    write_sources(hole, material.levels.front(), exemplar, size, sources);
    hole = {};
  }
  material = {};
  united.name_sources(sources);
  Texture texture = texture_of(std::move(sources), request.exemplars);
  for (int y = 0; y < asked.mask.height; ++y)
    for (int x = 0; x < asked.mask.width; ++x)
      if (*asked.mask.at(x, y) <= 0.5f)
        std::copy_n(asked.known.at(x, y), asked.known.channels, texture.image.at(x, y));
  return texture;
}

Cost estimate_directed(const PatchmatchParams& params, const RequestSize& request) {
  double samples = 0;
  bool copied = request.exemplars.size() > 1;  // to one picture
  for (const ExemplarSize& exemplar : request.exemplars) {
    samples += area(exemplar.size);
    copied |= exemplar.mask;
  }
  const double channels = request.exemplars.front().channels;
  const double target = area(request.size), made = target * request.made;
  const int planes = (request.exemplars.front().guide ? 1 : 0) + (request.weights ? 1 : 0);
  // A level has a quarter of the work of the next finer one, but more iterations.
  const double iterations = params.iterations * 4.0 / 3 + more_iterations * 4.0 / 9;
  // A fill works on what is about its holes, too, and grows their first pixels.
  const double tries = params.tries + (request.known ? more_tries : 0);
  const double work = request.known ? 3.6 : 1.3;
  const double labels =
      request.weights ? 8 + 4.0 * static_cast<double>(request.exemplars.size()) : 0;
  return {
      .bytes = target * labels + target * (request.known ? 16 + 8 * channels : 12 + 4 * channels) +
               made * (64 + 24.0 * planes) +
               samples *
                   (52 + 24.0 * planes + ((copied ? 8 : 4) + (request.weights ? 4 : 0)) * channels),
      .work = {.serial = (samples + target) * 1.1e-7,
               .shared = made * iterations * (45 + 15 * tries) * 1e-9 * (work + 0.5 * planes)}};
}

}  // namespace gramloom
