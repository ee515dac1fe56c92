// The whole training of an inference.
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "neural/openmp.h"
#include "train/finite_loss.h"
#include "train/inference_net.h"
#include "train/optimiser_state.h"
#include "train/train_module.h"

namespace gramloom::train {

namespace {

namespace fs = std::filesystem;

// The share of the learning rate: rising over 50 steps, then falling as a cosine to none.
double cosine_rate(int step, int steps) {
  return std::min(1.0, (step + 1) / 50.0) * 0.5 * (1 + std::cos(std::numbers::pi * step / steps));
}

// All pairs as the network sees them, and what brings pictures back.
struct Pairs {
  at::Tensor poses, pictures;             // (pairs, numbers), (pairs, channels, height, width)
  at::Tensor mean, deviation, low, high;  // of the pictures
};

Pairs pairs_of(const InferenceLesson& lesson) {
  const InferenceDescription& description = lesson.description;
  const auto count = static_cast<std::int64_t>(lesson.poses.size());
  const auto numbers = static_cast<std::int64_t>(description.pose.size());
  const Size size = description.size;
  Pairs pairs;
  pairs.poses = at::zeros({count, numbers}, at::kFloat);
  std::vector<at::Tensor> pictures;
  for (std::int64_t i = 0; i < count; ++i) {
    for (std::int64_t k = 0; k < numbers; ++k) {
      const PoseNumber& number = description.pose[static_cast<std::size_t>(k)];
      const double range = number.high - number.low;
      const double value = lesson.poses[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      pairs.poses[i][k] = range > 0 ? 2 * (value - number.low) / range - 1 : 0.0;
    }
    const Image& picture = lesson.pictures[static_cast<std::size_t>(i)];
    pictures.push_back(at::from_blob(const_cast<float*>(picture.pixels.data()),
                                     {size.height, size.width, description.channels}, at::kFloat)
                           .permute({2, 0, 1}));
  }
  const at::Tensor all = at::stack(pictures);
  const std::vector<std::int64_t> per_channel{0, 2, 3};
  pairs.low = all.amin(per_channel);
  pairs.high = all.amax(per_channel);
  pairs.mean = all.mean(0);
  const at::Tensor centred = all - pairs.mean;
  pairs.deviation = centred.square().mean(per_channel).sqrt().clamp_min(1e-12);
  pairs.pictures = (centred / pairs.deviation.view({1, -1, 1, 1})).contiguous();
  return pairs;
}

class InferenceTraining {
 public:
  InferenceTraining(const InferenceLesson& lesson, const Control& control,
                    const InferenceJudge& judge)
      : lesson_(lesson),
        control_(control),
        judge_(judge),
        pairs_(pairs_of(lesson)),
        net_(lesson.description),
        optimiser_(net_->parameters(), torch::optim::AdamOptions(lesson.recipe.learning_rate)) {
    model_.description = lesson.description;
    model_.tensors["pictures.mean"] = to_data(pairs_.mean);
    model_.tensors["pictures.deviation"] = to_data(pairs_.deviation);
    model_.tensors["pictures.low"] = to_data(pairs_.low);
    model_.tensors["pictures.high"] = to_data(pairs_.high);
  }

  InferenceModel run() {
    read_state();
    const int steps = lesson_.recipe.steps;
    auto kept_at = std::chrono::steady_clock::now();
    while (next_step_ < steps) {
      const Progress progress = step();
      check_finite_loss(progress);
      const bool last = next_step_ == steps;
      if (last || next_step_ % lesson_.recipe.sample_every == 0) look();
      const bool goes_on = control_.report(progress);
      const auto now = std::chrono::steady_clock::now();
      if (goes_on && (last || now - kept_at < std::chrono::minutes(1))) continue;
      kept_at = now;
      write_state();
      if (!goes_on) throw Interrupted();
    }
    for (auto& [name, tensor] : best_) model_.tensors[name] = std::move(tensor);
    return std::move(model_);
  }

 private:
  // One batch; which pairs are in it depends on seed and step alone.
  Progress step() {
    const InferenceRecipe& recipe = lesson_.recipe;
    Random random(static_cast<std::uint64_t>(recipe.seed), static_cast<std::uint64_t>(next_step_));
    const auto count = static_cast<std::uint32_t>(lesson_.poses.size());
    std::vector<std::int64_t> chosen(static_cast<std::size_t>(recipe.batch));
    for (std::int64_t& pair : chosen) pair = random.below(count);
    const at::Tensor batch = at::tensor(chosen, at::kLong);
    for (auto& group : optimiser_.param_groups())
      static_cast<torch::optim::AdamOptions&>(group.options())
          .lr(recipe.learning_rate * cosine_rate(next_step_, recipe.steps));
    const InferenceLoss terms =
        inference_loss(net_->forward(pairs_.poses.index_select(0, batch)),
                       pairs_.pictures.index_select(0, batch), lesson_.description.wraps);
    const at::Tensor loss = terms.values + recipe.slopes * terms.slopes;
    optimiser_.zero_grad();
    loss.backward();
    torch::nn::utils::clip_grad_norm_(net_->parameters(), 1.0);
    optimiser_.step();
    ++next_step_;
    Progress progress;
    progress.step = progress.evaluations = next_step_;
    progress.steps = recipe.steps;
    progress.loss = loss.item<double>();
    progress.terms = {{"values", terms.values.item<double>()},
                      {"slopes", terms.slopes.item<double>()}};
    return progress;
  }

  // Shows the state to the judge, and keeps the best.
  void look() {
    keep(*net_, "", model_.tensors);
    const double score =
        judge_ ? judge_({model_, next_step_, lesson_.recipe.steps}) : -1.0 * next_step_;
    if (!(score < best_score_)) return;
    best_score_ = score;
    best_.clear();
    keep(*net_, "", best_);
  }

  void write_state() {
    if (control_.checkpoint.empty()) return;
    Tensors tensors;
    keep(*net_, "net.", tensors);
    keep(optimiser_, "optimiser.", tensors);
    for (const auto& [name, tensor] : best_) tensors[best_prefix + name] = tensor;
    write_tensors(control_.checkpoint, tensors,
                  {{"identity", control_.identity},
                   {"step", fmt::format("{}", next_step_)},
                   {"best", fmt::format("{}", best_score_)}});
  }

  // Goes on from a checkpoint of the same work; one that is damaged, or of other work, is not used.
  void read_state() {
    const fs::path& file = control_.checkpoint;
    std::error_code ignored;
    if (file.empty() || !fs::exists(file, ignored)) return;
    Tensors begun;
    keep(*net_, "", begun);
    try {
      const auto metadata = read_metadata(file);
      if (metadata.at("identity") != control_.identity) return;
      const Tensors tensors = read_tensors(file);
      const int step = std::stoi(metadata.at("step"));
      const double score = std::stod(metadata.at("best"));
      restore(*net_, "net.", tensors);
      restore(optimiser_, "optimiser.", tensors);
      for (const auto& [name, tensor] : tensors)
        if (name.starts_with(best_prefix)) best_[name.substr(best_prefix.size())] = tensor;
      next_step_ = step;
      best_score_ = score;
    } catch (const std::exception&) {
      restore(*net_, "", begun);
      optimiser_.state().clear();
      best_.clear();
    }
  }

  static inline const std::string best_prefix = "best.";

  const InferenceLesson& lesson_;
  const Control& control_;
  const InferenceJudge& judge_;
  Pairs pairs_;
  InferenceNet net_;
  torch::optim::Adam optimiser_;
  InferenceModel model_ = {};
  int next_step_ = 0;
  double best_score_ = std::numeric_limits<double>::infinity();
  Tensors best_ = {};
};

}  // namespace

InferenceModel run_inference_training(const InferenceLesson& lesson, const Control& control,
                                      const InferenceJudge& judge) {
  neural::start_openmp();
  torch::manual_seed(static_cast<std::uint64_t>(lesson.recipe.seed));
  return InferenceTraining(lesson, control, judge).run();
}

}  // namespace gramloom::train
