#include <c10/core/GradMode.h>
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "core/threads.h"
#include "io/image_file.h"
#include "neural/checkpoint.h"
#include "neural/directed_levels.h"
#include "neural/directed_settings.h"
#include "neural/flow/first_fill.h"
#include "neural/flow/patch_flow.h"
#include "neural/flow/sparse_detail.h"
#include "neural/guidance.h"
#include "neural/layout.h"
#include "neural/loss/directed_places.h"
#include "neural/loss/loss.h"
#include "neural/made_pixels.h"
#include "neural/module.h"
#include "neural/network/make_network.h"
#include "neural/normal_numbers.h"
#include "neural/openmp.h"
#include "neural/picture.h"
#include "neural/resample.h"
#include "neural/settings.h"
#include "neural/settled_maps.h"
#include "neural/shared_rows.h"
#include "signal/fill_windows.h"
#include "signal/histogram_match.h"
#include "signal/layer_axes.h"
#include "signal/resize.h"

namespace gramloom::neural {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double seconds_between_checkpoints = 60;

enum class Stream : std::uint64_t { loss = 1, edges, layout, nearest, maps };

// The colours that the loss sees: an affine map of the exemplar's, undone for the result. Along the
// principal axes of each layer the deviation becomes d^(1 − whitening), in units of the layer's
// root mean square: layers are not mixed, and count alike whatever their units.
ColourPca seen_colours(const NeuralParams& params, const NetworkDescription& description,
                       const Exemplar& exemplar) {
  const auto blocks = channel_blocks(exemplar.layers, exemplar.image.channels);
  ColourPca colours = principal_axes(usable_pixels(exemplar.image, exemplar.mask), blocks);
  const auto channels = static_cast<std::size_t>(colours.channels);
  const auto common_of = [&](const ChannelBlock& block) {
    double variance = 0;
    for (int i = block.first; i < block.first + block.count; ++i) {
      const float d = colours.deviation[static_cast<std::size_t>(i)];
      variance += static_cast<double>(d) * d;
    }
    return std::sqrt(variance / block.count);
  };
  if (needs_network(params) && !params.weights.empty()) {  // what trained weights expect
    colours.deviation.assign(channels, static_cast<float>(common_of({0, exemplar.image.channels})));
    if (!description.input_mean.empty()) {
      colours.mean.assign(description.input_mean.begin(), description.input_mean.end());
      colours.deviation.assign(description.input_deviation.begin(),
                               description.input_deviation.end());
    }
    for (std::size_t i = 0; i < channels * channels; ++i)
      colours.axes[i] = i % (channels + 1) == 0 ? 1.0f : 0.0f;
  } else {
    for (const ChannelBlock& block : blocks) {
      const double common = common_of(block);
      for (int i = block.first; i < block.first + block.count; ++i)
        if (float& d = colours.deviation[static_cast<std::size_t>(i)]; d > 0)
          d = static_cast<float>(std::pow(d, params.whitening) *
                                 std::pow(common, 1 - params.whitening));
    }
  }
  return colours;
}

// With the layout that `automatic` stands for. Known pixels keep a thin line thin.
NeuralParams with_layout(NeuralParams params, const Exemplar& layered, const Request& request) {
  const Image& exemplar = layered.image;
  const int colours = channel_blocks(layered.layers, exemplar.channels).front().count;
  const bool automatic = params.layout == Layout::automatic;
  params.layout = layout_by_size(params, smallest_exemplar(size_of(request)), request.target);
  if (automatic && params.layout == Layout::flow && request.target.known.empty() &&
      sparse_detail(extract_channels(exemplar, 0, colours)) > too_sparse_for_flow)
    params.layout = Layout::noise;
  return params;
}

// One synthesis under way.
class Synthesis {
 public:
  Synthesis(const NeuralParams& params, const Request& request, const United& united,
            const Control& control, const Group& group)
      : group_(group),
        params_(with_layout(params, united.exemplar(), request)),
        target_(request.target),
        random_(request.random),
        control_(control),
        principal_(colour_pca(usable_pixels(united.exemplar().image, united.exemplar().mask))),
        levels_(level_count(params_, smallest_exemplar(size_of(request)), target_)),
        canvas_(canvas_size(params, target_)),
        start_(Clock::now()) {
    const Exemplar& layered = united.exemplar();
    const Image& exemplar = layered.image;
    if (needs_network(params)) {
      description_ = read_network(find_network(params.network));
      layers_ = matched_layers(params, description_);
      check_weights(params, description_, exemplar.channels);
    }
    colours_ = seen_colours(params, description_, layered);
    exemplar_ = to_planes(whitened(exemplar, colours_));
    guidance_ = guidance_of(request, united, canvas_, colours_);
    if (guidance_) levels_ = directed_levels(params_, *guidance_, exemplar.size(), levels_);
    if (needs_network(params)) {
      network_ = make_network(params, description_, exemplar_);
      matched_.emplace(*network_, description_, layers_);
    }
    if (params_.layout == Layout::flow)
      flow_.emplace(params_, exemplar_, Target{canvas_, target_.tile},
                    random_.stream(std::uint64_t(Stream::layout)),
                    guidance_ ? &*guidance_ : nullptr);
    state_.identity = control.identity;
  }

  at::Tensor run() {
    if (auto saved = read_checkpoint(control_.checkpoint, control_.identity)) {
      state_ = std::move(*saved);
      seconds_before_ = state_.seconds;
    } else {
      state_.level = state_.first_level = levels_ - 1;
    }
    last_checkpoint_ = Clock::now();
    while (run_level() && state_.level > 0) {
      const bool copied = copies_layout();
      --state_.level;
      state_.iteration = 0;
      state_.layout_step = 0;
      state_.optimiser = {};
      state_.nearest = at::Tensor();
      if (!copied) continue;
      state_.first_level = state_.level;
      state_.picture = at::Tensor();
    }
    return cropped();
  }

  const ColourPca& colours() const { return colours_; }

 private:
  // Those who have the picture together.
  const Group& holders() const { return shared_ ? group_ : one_process(); }
  std::int64_t height() const { return shared_ ? height_ : state_.picture.size(1); }
  HeldRows picture() const { return held_by(holders(), state_.picture, height()); }

  // Rows of the picture at another size, after it was moved by (y, x) across edges that wrap.
  at::Tensor resized(Size size, Rows rows, std::int64_t y = 0, std::int64_t x = 0) const {
    const Rows from = rows_to_resample(rows, height(), size.height, target_.tile);
    const RowExchange exchange(holders(), height(), {from.begin - y, from.end - y});
    HeldRows taken = exchange.take(picture());
    taken.rows = {taken.rows.begin + y, taken.rows.end + y};
    if (x != 0) taken.data = at::roll(taken.data, x, 2);
    return resample(taken, size, rows, target_.tile).data;
  }

  // The own rows of the texture. Stopped on a coarse level, the picture has that level's size.
  at::Tensor cropped() const {
    const Size size = target_.size;
    const std::int64_t margin = (canvas_.height - size.height) / 2;
    const Rows own = own_rows(group_, size.height);
    return resized(canvas_, {own.begin + margin, own.end + margin})
        .narrow(2, (canvas_.width - size.width) / 2, size.width)
        .contiguous();
  }

  Edges exemplar_edges() const { return {params_.exemplar_padding, params_.exemplar_padding}; }
  Edges edges() const {
    return {tiles_x(target_.tile) ? Padding::circular : params_.padding,
            tiles_y(target_.tile) ? Padding::circular : params_.padding};
  }

  // The own rows of it.
  at::Tensor first_picture(Size size, const Group& group) const {
    const Rows own = own_rows(group, size.height);
    const int channels = colours_.channels;
    if (params_.start.empty()) {
      // In the exemplar's colours: a hue that it lacks would have to be taken out again. And with
      // the maps that go with them: this noise alone is along the axes of all layers together.
      const at::Tensor white = white_noise(random_, channels, size, own).mul_(params_.noise);
      return to_planes(whitened(unwhitened(to_image(white), principal_), colours_));
    }
    const Image image = read_start(params_, channels);
    return resample(all_rows(to_planes(whitened(image, colours_))), size, own, target_.tile).data;
  }

  // The level's layout by patch flow matching, from the coarser level's picture; false when the
  // synthesis should stop.
  bool make_layout() {
    const std::int64_t steps = at_level(params_.flow_steps, state_.level);
    FlowState layout{state_.layout_step, state_.picture, {}, state_.prices, state_.sources};
    // Out of time, the coarser picture is only made larger; but there must be one.
    const auto skipped = [&] {
      return state_.layout_step == 0 && state_.picture.defined() && out_of_time();
    };
    while (state_.layout_step < steps && !skipped()) {
      flow_->step(layout, state_.level, state_.level == state_.first_level);
      state_.layout_step = layout.step;
      state_.picture = layout.picture;
      state_.prices = layout.prices;
      state_.sources = layout.sources;
      const bool go_on = report(std::numeric_limits<double>::quiet_NaN(), {});
      keep({}, !go_on);
      if (go_on) continue;
      state_.picture = layout.goal;
      return false;
    }
    if (state_.level == 0) state_.picture = flow_->fitted(state_.picture);
    state_.prices = at::Tensor();
    return true;
  }

  // Whether the level on which the picture began has brought back the exemplar's layout, and a
  // finer one, of at most half the exemplar's size, can be the first instead. A picture smaller
  // than the exemplar is always like one place of it.
  bool copies_layout() const {
    const double next = std::pow(flow_ ? 0.5 : params_.level_factor, state_.level - 1);
    if (params_.levels > 0 || state_.level != state_.first_level || next > 0.5) return false;
    if (guidance_ && guidance_->directs()) return false;
    if (!params_.start.empty() || out_of_time()) return false;
    const at::Tensor exemplar = exemplar_of_level();
    const Size own = picture().size(), size = size_of(exemplar);
    if (own.width < size.width || own.height < size.height) return false;
    const RowExchange all(holders(), height(), {0, height()});
    return layout_copied(all.take(picture()).data, exemplar, target_.tile) > params_.copy_limit;
  }

  at::Tensor exemplar_of_level() const {
    return resample(exemplar_, level_size(params_, size_of(exemplar_), state_.level), Tile::none);
  }

  // The own rows of the coarser level's picture, made larger. Values between pixels change fastest
  // midway, where the edges always lie: from level to level this would add up to a seam. But what
  // wraps has no edges, so they are elsewhere each time.
  at::Tensor enlarged(Size size, const Group& group) const {
    const Size old = picture().size();
    Random random = random_.stream(std::uint64_t(Stream::edges))
                        .stream(static_cast<std::uint64_t>(state_.level));
    const auto edge = [&](bool wraps, int side) {
      return wraps ? std::int64_t{random.below(static_cast<std::uint32_t>(side))} : 0;
    };
    const std::int64_t y = edge(tiles_y(target_.tile), old.height);
    const std::int64_t x = edge(tiles_x(target_.tile), old.width);
    const Rows own = own_rows(group, size.height);
    const std::int64_t down = y * size.height / old.height, right = x * size.width / old.width;
    return at::roll(resized(size, {own.begin + down, own.end + down}, y, x), -right, 2);
  }

  // Optimises one level; false when the synthesis should stop.
  bool run_level() {
    const bool resumed = state_.iteration > 0;
    const bool begins = !state_.picture.defined();
    if (begins && guidance_ && guidance_->fills() && params_.start.empty()) {
      const at::Tensor exemplar = exemplar_of_level();
      const Guidance guidance = with_shares_as_guide(
          scaled(*guidance_, size_of(exemplar), level_size(params_, canvas_, state_.level)));
      state_.picture = to_planes(
          first_fill(guidance, to_image(guidance.known), to_image(exemplar), first_patch()));
    }
    if (flow_ && !resumed && !make_layout()) return false;
    const Size size = flow_ ? size_of(state_.picture) : level_size(params_, canvas_, state_.level);
    const int iterations = at_level(params_.iterations, state_.level);
    const Optimizer kind = at_level(params_.optimizer, state_.level);
    const bool shared = is_shared(params_, size, group_.size());
    const Group& group = shared ? group_ : one_process();
    if (!state_.picture.defined()) {
      state_.picture = first_picture(size, group);
    } else if (!flow_ && !resumed && !begins) {
      // What each has made alone may differ in the last bits.
      if (shared && !shared_) state_.picture = from_first(group_, state_.picture);
      state_.picture = enlarged(size, group);
    }
    shared_ = shared;
    height_ = size.height;

    if (state_.iteration >= iterations || out_of_time()) return true;

    const at::Tensor exemplar = exemplar_of_level();
    std::optional<Guidance> guidance;
    if (guidance_) guidance = scaled(*guidance_, size_of(exemplar), size);
    if (!resumed && guidance && guidance->fills()) {
      keep_known(*guidance, state_.picture);
      state_.nearest = nearest_places(*guidance, exemplar, state_.picture, largest_patch(),
                                      random_.stream(std::uint64_t(Stream::nearest))
                                          .stream(static_cast<std::uint64_t>(state_.level)));
    }

    malloc_trim(0);  // the buffers of the level before have other sizes, and would stay
    Loss loss(params_, matched_ ? &*matched_ : nullptr, exemplar, exemplar_edges(),
              {size, target_.tile}, edges(),
              random_.stream(std::uint64_t(Stream::loss))
                  .stream(static_cast<std::uint64_t>(state_.level)),
              guidance ? &*guidance : nullptr, state_.nearest, group);
    // L-BFGS needs the same function at each step; Adam takes random ones.
    const Objective objective = [&](const at::Tensor& picture, at::Tensor& gradient) {
      const auto step = kind == Optimizer::adam ? state_.iteration : 0;
      ++state_.evaluations;
      return loss(picture, static_cast<std::uint64_t>(step), gradient);
    };
    // Of a fill, the pixels that are made alone.
    const MadePixels made(guidance ? *guidance : Guidance());
    const Objective of_made = [&](const at::Tensor& pixels, at::Tensor& gradient) {
      made.put(pixels, state_.picture);
      at::Tensor whole = at::empty_like(state_.picture);
      const double value = objective(state_.picture, whole);
      gradient.copy_(made.take(whole));
      return value;
    };
    AnyOptimiser optimiser = kind == Optimizer::lbfgs
                                 ? AnyOptimiser(Lbfgs(params_.history, group))
                                 : AnyOptimiser(Adam(params_.learning_rate, iterations));
    return std::visit(
        [&](auto& method) {
          if (resumed) method.load(state_.optimiser);
          at::Tensor pixels = made.all() ? state_.picture : made.take(state_.picture);
          while (!first_says(state_.iteration >= iterations || method.converged())) {
            const double value = method.step(pixels, made.all() ? objective : of_made);
            if (!made.all()) made.put(pixels, state_.picture);
            if (!std::isfinite(value))
              throw Error("the loss became {} at step {}: try a smaller learning_rate", value,
                          state_.iteration + 1);
            if (state_.iteration++ == 0) state_.first_loss = value;
            const bool go_on = report(value, loss.terms());
            // The level is done, also for one who goes on from here later.
            if (first_says(value <= params_.stop_loss * state_.first_loss) || out_of_time())
              state_.iteration = iterations;
            keep([&] { return method.save(); }, !go_on);
            if (!go_on) return false;
          }
          return true;
        },
        optimiser);
  }

  int first_patch() const { return std::max(largest_patch(), 8); }
  int largest_patch() const { return *std::ranges::max_element(params_.patch_sizes); }

  // What each process makes alone may differ in its last bits: the first one says when all go on.
  bool first_says(bool own) const {
    if (group_.alone()) return own;
    std::int32_t said = own;
    group_.first(std::span(&said, 1));
    return said != 0;
  }

  // Finer levels then only make the picture larger; something must have been done first.
  bool out_of_time() const {
    if (state_.evaluations == 0 || std::isinf(params_.stop_seconds)) return false;
    return group_.any(seconds() >= params_.stop_seconds);
  }

  double seconds() const {
    return seconds_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
  }

  bool report(double value, const std::vector<Term>& terms) const {
    Progress progress;
    progress.steps = steps_down_to(params_, levels_, 0);
    progress.step =
        steps_down_to(params_, levels_, state_.level + 1) + state_.layout_step + state_.iteration;
    progress.evaluations = state_.evaluations;
    progress.loss = value;
    progress.terms = terms;
    return !group_.any(!control_.report(progress));
  }

  // saved(): the optimiser's state.
  void keep(const std::function<SavedState()>& saved, bool now) {
    const double age = std::chrono::duration<double>(Clock::now() - last_checkpoint_).count();
    if (control_.checkpoint.empty() || (!now && age < seconds_between_checkpoints)) return;
    state_.seconds = seconds();
    state_.optimiser = saved ? saved() : SavedState();
    write_checkpoint(control_.checkpoint, state_);
    last_checkpoint_ = Clock::now();
  }

  const Group& group_;
  const NeuralParams params_;
  const Target& target_;
  Random random_;
  const Control& control_;
  ColourPca principal_, colours_;
  int levels_;
  Size canvas_;
  NetworkDescription description_;
  std::vector<MatchedLayer> layers_;
  at::Tensor exemplar_;
  std::optional<Guidance> guidance_;  // nothing: the exemplar as a whole
  std::optional<PatchFlow> flow_;     // undefined: levels begin with the coarser one's picture
  std::optional<Network> network_;
  std::optional<MatchedNetwork> matched_;
  Checkpoint state_;
  bool shared_ = false;      // whether state_.picture is the own rows of one that is
  std::int64_t height_ = 0;  // so high
  double seconds_before_ = 0;
  Clock::time_point start_, last_checkpoint_;
};

// The maps as the colours tell them.
void settle(const Exemplar& exemplar, const Request& request, const Group& group, Image& own) {
  if (exemplar.layers.size() < 2) return;
  const Random random = request.random.stream(std::uint64_t(Stream::maps));
  std::vector<Layer> layers = told_layers(exemplar, random);
  // What each process finds may differ in the last bits: the first one says which are told.
  std::vector<std::int32_t> told(exemplar.layers.size());
  for (std::size_t i = 0; i < told.size(); ++i)
    told[i] = std::ranges::count(layers, exemplar.layers[i]) > 0 ? 1 : 0;
  if (!group.alone()) group.first(std::span(told));
  layers.clear();
  for (std::size_t i = 0; i < told.size(); ++i)
    if (told[i] != 0) layers.push_back(exemplar.layers[i]);
  if (layers.empty()) return;
  const std::int64_t height = request.target.size.height;
  const Rows rows = own_rows(group, height);
  if (group.alone()) {
    settle_maps(exemplar, layers, request.target.tile, random, {own, 0, height}, rows, group, own);
    return;
  }
  const RowExchange exchange(group, height,
                             {rows.begin - settled_margin, rows.end + settled_margin});
  const Image around = to_image(exchange.take(held_by(group, to_planes(own), height)).data);
  settle_maps(exemplar, layers, request.target.tile, random,
              {around, rows.begin - settled_margin, height}, rows, group, own);
}

Texture synthesise_whole(const NeuralParams& params, const Request& request, const Control& control,
                         const Group& group) {
  const United united(request);
  const Exemplar& exemplar = united.exemplar();
  Synthesis synthesis(params, request, united, control, group);
  Texture texture;
  texture.image = unwhitened(to_image(synthesis.run()), synthesis.colours());
  settle(exemplar, request, group, texture.image);
  const Image pixels = usable_pixels(exemplar.image, exemplar.mask);
  if (params.match_histogram) match_histogram(texture.image, pixels);
  clamp_to(texture.image, channel_range(pixels));
  copy_known(request.target, texture.image);
  return texture;
}

}  // namespace

Texture run_synthesis(const NeuralParams& asked, const Request& request, const Control& control,
                      const Group& group) {
  const c10::NoGradGuard no_gradients;
  start_openmp();
  const RequestSize size = size_of(request);
  const NeuralParams params = directed_settings(asked, size, has_one_mix(request.target));
  if (!group.alone() || !fills_window(params, size))
    return synthesise_whole(params, request, control, group);
  const FillWindow window = window_about_holes(request.target);
  return fill_by_windows(
      request, {window},
      [&](const Request& part, const Control& own) {
        Texture texture = synthesise_whole(params, part, own, group);
        // Stopped on a coarse level, it has that level's size.
        if (texture.image.size() != window.size) texture.image = resize(texture.image, window.size);
        return texture;
      },
      control);
}

}  // namespace gramloom::neural
