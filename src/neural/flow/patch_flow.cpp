#include "neural/flow/patch_flow.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "neural/directed_settings.h"
#include "neural/flow/band_match.h"
#include "neural/flow/memory.h"
#include "neural/flow/nearest.h"
#include "neural/flow/octave_guidance.h"
#include "neural/flow/patch_axes.h"
#include "neural/flow/prices.h"
#include "neural/flow/vote.h"
#include "neural/normal_numbers.h"
#include "neural/openmp.h"
#include "neural/picture.h"
#include "neural/resample.h"
#include "neural/settings.h"
#include "signal/courses.h"

namespace gramloom::neural {

namespace {

constexpr int axes_kept = 48;
constexpr double window_spread = 0.25;  // of a patch's side
constexpr double price_spread = 0.25;   // likewise: patches that lie this near are one
constexpr float courses_time = 0.45f;   // at which the courses are laid out
constexpr float bands_until = 0.9f;     // the time up to which bands are matched

enum class Stream : std::uint64_t { axes, noise, shift, references, queries, memory };

// `count` of 0 … total − 1, in rising order; all of them if there are no more.
std::vector<std::int64_t> draw(std::int64_t count, std::int64_t total, Random random) {
  std::vector<std::int64_t> drawn;
  if (count >= total) {
    drawn.resize(static_cast<std::size_t>(total));
    std::iota(drawn.begin(), drawn.end(), 0);
    return drawn;
  }
  // Each is taken with the probability that is still wanted (Knuth, selection sampling).
  for (std::int64_t i = 0, left = count; left > 0; ++i)
    if (random.uniform() * static_cast<float>(total - i) < static_cast<float>(left)) {
      drawn.push_back(i);
      --left;
    }
  return drawn;
}

// The courses of a layout on one axis, and its `side`: a whole number of them, cropped afterwards,
// or stretched or pressed where the target tiles: by a third at most, or there are none.
PeriodicAxis courses_along(const Image& exemplar, Axis axis, bool tiles, int& side) {
  const Courses courses = find_courses(exemplar, axis);
  if (courses.contrast < clear_courses) return {};
  constexpr double most_stretched = 1.35;
  const int unit = courses.alternate ? 2 : 1;
  const double units = side / (courses.period * unit);
  const int count =
      unit * std::max(1, static_cast<int>(tiles ? std::round(units) : std::ceil(units - 1e-6)));
  const double whole = count * courses.period;
  if (tiles && (whole > most_stretched * side || side > most_stretched * whole)) return {};
  side = static_cast<int>(std::lround(whole));
  return {courses.period, count};
}

// Of each query's neighbours: exp(−|y − t x|² / 2 (1 − t)²), relative to the nearest; their sum
// is 1.
std::vector<float> likelihoods(const Neighbours& found, float t) {
  std::vector<float> weights = found.cost;
  const float variance = 2 * std::max(1 - t, 1e-3f) * std::max(1 - t, 1e-3f);
  const auto k = static_cast<std::size_t>(found.neighbours);
  for (std::size_t i = 0; i < weights.size(); i += k) {
    const float least = weights[i];
    float sum = 0;
    for (std::size_t j = 0; j < k; ++j)
      sum += weights[i + j] = std::exp((least - weights[i + j]) / variance);
    for (std::size_t j = 0; j < k; ++j) weights[i + j] /= sum;
  }
  return weights;
}

}  // namespace

struct PatchFlow::Octave {
  int index;
  Image exemplar;
  Size size, places;
  PatchAxes axes;
  std::vector<BandStatistics> bands;  // of each region
  std::vector<float> window;
  std::vector<float> times;  // times[i] before step i
  std::optional<OctaveGuidance> guidance;

  bool fills() const { return guidance && guidance->fills(); }
  bool guides() const { return guidance && guidance->guides(); }
};

PatchFlow::PatchFlow(const FlowParams& params, const at::Tensor& exemplar, const Target& target,
                     Random random, const Guidance* guidance)
    : params_(params), target_(target), size_(target.size), random_(random), guidance_(guidance) {
  const double square = [&] {
    const InThisThread in_this_thread;  // the same sum for any number of threads
    return exemplar.square().mean().item<double>();
  }();
  scale_ = square > 0 ? 1 / std::sqrt(square) : 1;
  exemplar_ = exemplar * scale_;
  if (guidance && (guidance->directs() || !guidance->whole)) return;
  const Image image = to_image(exemplar);
  x_ = courses_along(image, Axis::x, tiles_x(target.tile), size_.width);
  y_ = courses_along(image, Axis::y, tiles_y(target.tile), size_.height);
}
PatchFlow::~PatchFlow() = default;

PatchFlow::Octave& PatchFlow::octave(int index, bool coarsest) {
  if (octave_ && octave_->index == index) return *octave_;
  const double factor = std::pow(0.5, index);
  const auto scaled = [&](std::int64_t side) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) * factor)));
  };
  auto o = std::make_unique<Octave>();
  o->index = index;
  o->size = {scaled(size_.width), scaled(size_.height)};
  o->exemplar = to_image(
      resample(exemplar_, {scaled(exemplar_.size(2)), scaled(exemplar_.size(1))}, Tile::none));
  const int side = at_level(params_.flow_patch_sizes, index);
  o->places = patch_places(o->exemplar.size(), side);
  const auto part = static_cast<std::uint64_t>(index);
  const Random of_axes = random_.stream(part).stream(std::uint64_t(Stream::axes));
  if (guidance_) {
    o->guidance.emplace(*guidance_, o->exemplar.size(), o->size, side);
    o->axes = patch_axes(o->exemplar, side, axes_kept, of_axes, o->guidance->usable());
  } else {
    o->axes = patch_axes(o->exemplar, side, axes_kept, of_axes);
  }
  o->bands = band_statistics(o->exemplar, Tile::none, o->size,
                             o->guidance ? o->guidance->exemplar_regions() : Regions());
  o->window = vote_window(side, window_spread);
  const int steps = at_level(params_.flow_steps, index);
  if (coarsest && !o->fills() &&
      x_.count + y_.count == 0) {  // the first step, towards the mean, is known
    for (int i = 1; i < steps + 2; ++i)
      o->times.push_back(static_cast<float>(i) / static_cast<float>(steps + 1));
  } else {
    const float first = coarsest && !o->fills()
                            ? courses_time
                            : static_cast<float>(at_level(params_.flow_renoise, index));
    for (int i = 0; i <= steps; ++i)
      o->times.push_back(first + (1 - first) * static_cast<float>(i) / static_cast<float>(steps));
  }
  octave_ = std::move(o);
  return *octave_;
}

void PatchFlow::step(FlowState& state, int index, bool coarsest) {
  Octave& o = octave(index, coarsest);
  const Random random = random_.stream(static_cast<std::uint64_t>(index));
  const int channels = o.exemplar.channels;
  if (state.step == 0) {
    const at::Tensor noise =
        white_noise(random.stream(std::uint64_t(Stream::noise)), channels, o.size);
    const float t = o.times[0];
    if (coarsest && !o.fills()) {
      state.sources = at::Tensor();  // of a layout that was thrown away
      const auto scaled = [&](PeriodicAxis axis, int own, std::int64_t whole) {
        return PeriodicAxis{axis.period * own / static_cast<double>(whole), axis.count};
      };
      const Image mean = periodic_part(o.exemplar, scaled(x_, o.exemplar.width, exemplar_.size(2)),
                                       scaled(y_, o.exemplar.height, exemplar_.size(1)), o.size);
      state.picture = noise * (1 - t) + to_planes(mean) * t;
    } else {
      state.picture = resample(state.picture, o.size, Tile::both) * (scale_ * t) + noise * (1 - t);
    }
    state.prices = at::zeros({o.places.height, o.places.width}, at::kFloat);
    if (o.fills()) keep_known(o.guidance->guidance(), state.picture, scale_ * t);
  }
  const auto at_step = [&](Stream stream) {
    return random.stream(std::uint64_t(stream)).stream(static_cast<std::uint64_t>(state.step));
  };
  const float t = o.times[static_cast<std::size_t>(state.step)];
  const float next = o.times[static_cast<std::size_t>(state.step) + 1];
  const int side = o.axes.side;
  const Image picture = to_image(state.picture);

  // The patches that vote, and their references.
  Random shift = at_step(Stream::shift);
  const int shift_x = static_cast<int>(shift.below(patch_stride)),
            shift_y = static_cast<int>(shift.below(patch_stride));
  std::vector<PatchPlace> queries, references;
  if (o.fills())
    queries = o.guidance->queries(shift_x, shift_y);
  else
    for (int y = 0; y < o.size.height; y += patch_stride)
      for (int x = 0; x < o.size.width; x += patch_stride)
        queries.push_back({(x + shift_x) % o.size.width, (y + shift_y) % o.size.height});
  const std::int64_t patches = o.guidance ? std::ssize(o.guidance->usable())
                                          : std::int64_t{o.places.width} * o.places.height;
  const double pixels = static_cast<double>(o.size.width) * o.size.height;
  const std::int64_t looked_at = o.fills()
                                     ? std::min(patches, looked_at_for_a_fill(std::ssize(queries)))
                                     : params_.references(patches, pixels);
  for (const std::int64_t i : draw(looked_at, patches, at_step(Stream::references)))
    references.push_back(o.guidance ? o.guidance->usable()[static_cast<std::size_t>(i)]
                                    : PatchPlace{static_cast<int>(i % o.places.width),
                                                 static_cast<int>(i / o.places.width)});
  Vectors of_picture = project(picture, queries, o.axes);
  Vectors of_exemplar = project(o.exemplar, references, o.axes);
  const std::int64_t dimensions = of_exemplar.dimensions;
  std::vector<float> norms(references.size());
  for (std::size_t r = 0; r < norms.size(); ++r) {
    const float* v = of_exemplar.at(static_cast<std::int64_t>(r));
    norms[r] = t * t * std::inner_product(v, v + of_exemplar.dimensions, v, 0.0f);
  }

  if (o.guides()) {
    of_picture = o.guidance->guided().queries(std::move(of_picture), queries);
    of_exemplar = o.guidance->guided().references(std::move(of_exemplar), references, t);
  }

  float* prices = state.prices.data_ptr<float>();
  if (params_.flow_price > 0) {
    update_prices({o.places, prices}, references, of_picture, of_exemplar, norms, t,
                  {params_.flow_price, price_spread * side, state.step == 0 ? 4 : 2,
                   o.guides() ? dimensions : 0},
                  at_step(Stream::queries));
    if (o.guides()) o.guidance->level({o.places, prices});
  }
  std::vector<float> offsets = norms;
  for (std::size_t r = 0; r < offsets.size(); ++r)
    offsets[r] += prices[references[r].y * o.places.width + references[r].x];
  Neighbours found = nearest_references(of_picture, of_exemplar, offsets, t,
                                        at_level(params_.flow_neighbours, index));

  const double remembered = o.fills() ? 0 : params_.remembered();
  if (remembered > 0 && state.sources.defined()) {
    const auto vectors_of = [&](const std::vector<PatchPlace>& places) {
      Vectors vectors = project(o.exemplar, places, o.axes);
      return o.guides() ? o.guidance->guided().references(std::move(vectors), places, t) : vectors;
    };
    const auto is_usable = [&](PatchPlace p) { return !o.guidance || o.guidance->is_usable(p); };
    remember({state.sources, o.size, state.step == 0},
             {queries, of_picture, t, {o.places, prices}, dimensions, vectors_of, is_usable},
             remembered, at_step(Stream::memory), references, found);
  }
  if (remembered > 0) state.sources = sources_of(o.size, queries, references, found);

  of_picture = {};  // large

  std::vector<float> weights = likelihoods(found, t);
  if (o.fills()) o.guidance->add_confidence(queries, weights);
  Image goal = vote(o.size, queries, o.exemplar, references, found, weights, side, o.window,
                    o.guidance ? o.guidance->agreement() : Agreement());
  if (o.fills()) {
    at::Tensor whole = to_planes(goal);
    keep_known(o.guidance->guidance(), whole, scale_);
    goal = to_image(whole);
  }
  if (t < bands_until)
    match_bands(goal, o.bands, o.guidance ? o.guidance->regions() : Regions(), !o.fills());
  state.goal = to_planes(goal);
  if (o.fills()) keep_known(o.guidance->guidance(), state.goal, scale_);
  state.picture += (state.goal - state.picture) * ((next - t) / (1 - t));
  if (o.fills()) keep_known(o.guidance->guidance(), state.picture, scale_ * next);
  state.goal /= scale_;
  if (++state.step == at_level(params_.flow_steps, index)) state.picture /= scale_;
}

at::Tensor PatchFlow::fitted(at::Tensor picture) {
  octave_.reset();  // large, and not needed any more
  const auto fit = [&](std::int64_t axis, bool tiles, int side) {
    const std::int64_t own = picture.size(axis);
    if (own == side) return;
    if (!tiles && own > side) {
      picture = picture.narrow(axis, (own - side) / 2, side);
      return;
    }
    Size size{static_cast<int>(picture.size(2)), static_cast<int>(picture.size(1))};
    (axis == 1 ? size.height : size.width) = side;
    picture = resample(picture.contiguous(), size, Tile::both);
  };
  fit(1, tiles_y(target_.tile), target_.size.height);
  fit(2, tiles_x(target_.tile), target_.size.width);
  return picture.contiguous();
}

}  // namespace gramloom::neural
