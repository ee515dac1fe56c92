#include "neural/synthesis.h"

#include <ATen/Parallel.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "core/histogram_match.h"
#include "core/threads.h"
#include "io/image_file.h"
#include "neural/checkpoint.h"
#include "neural/loss.h"
#include "neural/picture.h"
#include "neural/resample.h"
#include "neural/settings.h"

namespace gramloom {

namespace {

using namespace neural;
using Clock = std::chrono::steady_clock;

constexpr double seconds_between_checkpoints = 60;

// The colours that a network sees: an affine map of the exemplar's, undone for the result.
ColourPca network_colours(const NeuralParams& params, const NetworkDescription& description,
                          const Image& exemplar) {
  check_weights(params, description, exemplar.channels);
  ColourPca colours = colour_pca(exemplar);
  if (params.weights.empty() && params.whiten_colour) return colours;
  const auto channels = static_cast<std::size_t>(colours.channels);
  double variance = 0;
  for (const float d : colours.deviation) variance += static_cast<double>(d) * d;
  const auto deviation = static_cast<float>(std::sqrt(variance / colours.channels));
  colours.deviation.assign(channels, deviation);
  if (!params.weights.empty() && !description.input_mean.empty()) {
    colours.mean.assign(description.input_mean.begin(), description.input_mean.end());
    colours.deviation.assign(description.input_deviation.begin(),
                             description.input_deviation.end());
  }
  for (std::size_t i = 0; i < channels * channels; ++i)
    colours.axes[i] = i % (channels + 1) == 0 ? 1.0f : 0.0f;
  return colours;
}

at::Tensor noise(Random random, int channels, Size size) {
  at::Tensor planes = at::empty({channels, size.height, size.width}, at::kFloat);
  float* values = planes.data_ptr<float>();
  parallel_for(std::int64_t{channels} * size.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      Random own = random.stream(static_cast<std::uint64_t>(row));
      for (int x = 0; x < size.width; ++x) values[row * size.width + x] = own.normal();
    }
  });
  return planes;
}

Size scaled(Size size, double factor) {
  const auto scale = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(side * factor)));
  };
  return {scale(size.width), scale(size.height)};
}

// One synthesis under way.
class Synthesis {
 public:
  Synthesis(const NeuralParams& params, const Image& exemplar, const Target& target, Random random,
            const Control& control)
      : params_(params),
        target_(target),
        random_(random),
        control_(control),
        description_(read_network(find_network(params.network))),
        layers_(matched_layers(params, description_)),
        colours_(network_colours(params, description_, exemplar)),
        exemplar_(to_planes(whitened(exemplar, colours_))),
        network_(make_network(params, description_, exemplar_)),
        start_(Clock::now()) {
    state_.fingerprint = fingerprint(params, exemplar, target, random);
  }

  at::Tensor run() {
    if (auto saved = read_checkpoint(control_.checkpoint, state_.fingerprint)) {
      state_ = std::move(*saved);
      seconds_before_ = state_.seconds;
    } else {
      state_.level = params_.levels - 1;
    }
    last_checkpoint_ = Clock::now();
    while (run_level() && state_.level > 0) {
      --state_.level;
      state_.iteration = 0;
      state_.optimiser = {};
    }
    // Stopped on a coarse level, it has that level's size.
    return resample(state_.picture, target_.size, wrapped_axes(edges()));
  }

  const ColourPca& colours() const { return colours_; }

 private:
  Edges exemplar_edges() const { return {params_.exemplar_padding, params_.exemplar_padding}; }
  Edges edges() const {
    return {tiles_x(target_.tile) ? Padding::circular : params_.padding,
            tiles_y(target_.tile) ? Padding::circular : params_.padding};
  }
  double level_scale() const { return std::pow(params_.level_factor, state_.level); }

  at::Tensor first_picture(Size size) const {
    const int channels = colours_.channels;
    if (params_.start.empty()) return noise(random_, channels, size).mul_(params_.noise);
    const Image image = read_image(params_.start).image;
    if (image.channels != channels)
      throw Error("{}: has {} channels, the exemplar has {}", params_.start.string(),
                  image.channels, channels);
    return resample(to_planes(whitened(image, colours_)), size, wrapped_axes(edges()));
  }

  // Optimises one level; false when the synthesis should stop.
  bool run_level() {
    const Size size = scaled(target_.size, level_scale());
    const Size exemplar_size = scaled(
        {static_cast<int>(exemplar_.size(2)), static_cast<int>(exemplar_.size(1))}, level_scale());
    const bool resumed = state_.iteration > 0;
    if (!state_.picture.defined())
      state_.picture = first_picture(size);
    else if (!resumed)
      state_.picture = resample(state_.picture, size, wrapped_axes(edges()));

    Loss loss(network_, description_, layers_,
              {params_.normalise, params_.centre, params_.standardise},
              resample(exemplar_, exemplar_size, Tile::none), exemplar_edges(), edges());
    const Objective objective = [&](const at::Tensor& picture, at::Tensor& gradient) {
      ++state_.evaluations;
      return loss(picture, gradient);
    };
    AnyOptimiser optimiser = params_.optimizer == Optimizer::lbfgs
                                 ? AnyOptimiser(Lbfgs(params_.history))
                                 : AnyOptimiser(Adam(params_.learning_rate));
    return std::visit(
        [&](auto& method) {
          if (resumed) method.load(state_.optimiser);
          while (state_.iteration < params_.iterations && !method.converged()) {
            const double value = method.step(state_.picture, objective);
            if (!std::isfinite(value))
              throw Error("the loss became {} at step {}: try a smaller learning_rate", value,
                          state_.iteration + 1);
            if (state_.iteration++ == 0) state_.first_loss = value;
            const bool go_on = report(value, loss.terms());
            // The level is done, also for one who goes on from here later.
            if (value <= params_.stop_loss * state_.first_loss || seconds() >= params_.stop_seconds)
              state_.iteration = params_.iterations;
            keep(method, !go_on);
            if (!go_on) return false;
          }
          return true;
        },
        optimiser);
  }

  double seconds() const {
    return seconds_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
  }

  bool report(double value, const std::vector<Term>& terms) const {
    Progress progress;
    progress.steps = std::int64_t{params_.levels} * params_.iterations;
    progress.step =
        std::int64_t{params_.levels - 1 - state_.level} * params_.iterations + state_.iteration;
    progress.evaluations = state_.evaluations;
    progress.loss = value;
    progress.terms = terms;
    return control_.report(progress);
  }

  template <class Method>
  void keep(const Method& method, bool now) {
    const double age = std::chrono::duration<double>(Clock::now() - last_checkpoint_).count();
    if (control_.checkpoint.empty() || (!now && age < seconds_between_checkpoints)) return;
    state_.seconds = seconds();
    state_.optimiser = method.save();
    write_checkpoint(control_.checkpoint, state_);
    last_checkpoint_ = Clock::now();
  }

  const NeuralParams& params_;
  const Target& target_;
  Random random_;
  const Control& control_;
  NetworkDescription description_;
  std::vector<Loss::MatchedLayer> layers_;
  ColourPca colours_;
  at::Tensor exemplar_;
  Network network_;
  Checkpoint state_;
  double seconds_before_ = 0;
  Clock::time_point start_, last_checkpoint_;
};

}  // namespace

Texture synthesise(const NeuralParams& params, const Image& exemplar, const Target& target,
                   Random random, const Control& control) {
  check_fields(params);
  const at::NoGradGuard no_gradients;
  at::set_num_threads(thread_count());
  Synthesis synthesis(params, exemplar, target, random, control);
  Texture texture;
  texture.image = unwhitened(to_image(synthesis.run()), synthesis.colours());
  if (params.match_histogram) match_histogram(texture.image, exemplar);
  clamp_to(texture.image, channel_range(exemplar));
  return texture;
}

}  // namespace gramloom
