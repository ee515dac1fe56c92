#include "train/generator_stage.h"

#include <algorithm>
#include <cmath>

#include "train/patch_loss.h"

namespace gramloom::train {

namespace {

// The share of the first learning rate: rising over 20 steps, falling to a tenth over the second
// half.
double rate_at(int step, int steps) {
  const double done = 1.0 * step / steps;
  return std::min(1.0, (step + 1) / 20.0) * (done < 0.5 ? 1 : std::pow(0.1, (done - 0.5) / 0.5));
}

void set_rate(torch::optim::Adam& optimiser, double rate) {
  for (auto& group : optimiser.param_groups())
    static_cast<torch::optim::AdamOptions&>(group.options()).lr(rate);
}

std::unique_ptr<torch::optim::Adam> adam(const std::vector<at::Tensor>& parameters, double rate,
                                         double first_beta) {
  return std::make_unique<torch::optim::Adam>(
      parameters, torch::optim::AdamOptions(rate).betas({first_beta, 0.99}));
}

// Weights lie as oneDNN reads them.
void use_channels_last(torch::nn::Module& module) {
  for (at::Tensor& parameter : module.parameters())
    if (parameter.dim() == 4)
      parameter.set_data(parameter.detach().contiguous(at::MemoryFormat::ChannelsLast));
}

// A level's pictures in training: at most `crop`, and whole on the coarsest level.
Size training_size(const GeneratorLesson& lesson, const at::Tensor& exemplar, int level) {
  const auto side = [&](std::int64_t length) {
    const int longest = std::min(lesson.recipe.crop, static_cast<int>(length));
    return std::max(1, longest >> level) << level;
  };
  return {side(exemplar.size(3)), side(exemplar.size(2))};
}

at::Tensor shares_of(const GeneratorLesson& lesson, int material) {
  at::Tensor shares =
      at::zeros({static_cast<std::int64_t>(lesson.description.materials.size())}, at::kFloat);
  shares[material] = 1;
  return shares;
}

std::uint64_t seed_of(int seed, int level, int step) {
  return static_cast<std::uint64_t>(seed) * 1'000'003u +
         static_cast<std::uint64_t>(level) * 10'000'019u + static_cast<std::uint64_t>(step);
}

}  // namespace

at::Tensor noise_like(const LevelNet& net, int batch, Size size) {
  const at::Tensor uniform = at::rand({batch, net->noise_channels, size.height, size.width});
  return ((uniform - 0.5) * std::sqrt(12.0)).contiguous(at::MemoryFormat::ChannelsLast);
}

at::Tensor GeneratorNets::coarser_picture(int level, int batch, Size size,
                                          const at::Tensor& shares) {
  if (level == 0) return {};
  const torch::NoGradGuard no_gradients;
  return upsampled(picture(level - 1, batch, {size.width / 2, size.height / 2}, shares),
                   Border::wraps);
}

at::Tensor GeneratorNets::picture(int level, int batch, Size size, const at::Tensor& shares) {
  const at::Tensor coarser = coarser_picture(level, batch, size, shares);
  LevelNet& net = levels[static_cast<std::size_t>(level)];
  return net->forward(coarser, noise_like(net, batch, size), shares, Border::wraps);
}

GeneratorStage::GeneratorStage(const GeneratorLesson& lesson, const LessonPictures& pictures,
                               GeneratorNets& nets, int level, std::vector<Discriminator> before)
    : lesson_(lesson),
      pictures_(pictures),
      nets_(nets),
      level_(level),
      steps_(at_level(lesson.recipe.steps, level)),
      batch_(at_level(lesson.recipe.batch, level)),
      adversary_(at_level(lesson.recipe.adversary, level)),
      reconstruction_(level == 0 ? 0 : at_level(lesson.recipe.reconstruction, level)) {
  const GeneratorRecipe& recipe = lesson.recipe;
  torch::manual_seed(seed_of(recipe.seed, level, -1));
  LevelNet& net = nets.levels[static_cast<std::size_t>(level)];
  use_channels_last(*net);
  parameters_ = net->parameters();
  optimiser_ = adam(parameters_, recipe.learning_rate, adversary_ > 0 ? 0.5 : 0.9);
  if (adversary_ == 0) return;
  std::vector<at::Tensor> all;
  for (std::size_t m = 0; m < pictures.pyramids.size(); ++m) {
    Discriminator discriminator(static_cast<int>(pictures.axes.channels), recipe.adversary_hidden,
                                recipe.adversary_layers);
    if (m < before.size()) {
      Tensors tensors;
      train::keep(*before[m], "", tensors);
      train::restore(*discriminator, "", tensors);
    }
    use_channels_last(*discriminator);
    for (const at::Tensor& parameter : discriminator->parameters()) all.push_back(parameter);
    discriminators_.push_back(std::move(discriminator));
  }
  adversary_optimiser_ = adam(all, recipe.learning_rate, 0.5);
}

at::Tensor GeneratorStage::judged(int material, const at::Tensor& picture, const at::Tensor&,
                                  bool wraps) {
  return discriminators_[static_cast<std::size_t>(material)]->forward(picture, wraps);
}

// The hinge loss: what is real above 1, what is made below −1.
float GeneratorStage::train_discriminator(int material, const at::Tensor& picture,
                                           const at::Tensor& coarser) {
  const at::Tensor& exemplar =
      pictures_.pyramids[static_cast<std::size_t>(material)][static_cast<std::size_t>(level_)];
  const at::Tensor real = judged(material, exemplar, {}, false);
  const at::Tensor made = judged(material, picture.detach(), coarser, true);
  const at::Tensor loss = at::relu(1 - real).mean() + at::relu(1 + made).mean();
  adversary_optimiser_->zero_grad();
  loss.backward();
  adversary_optimiser_->step();
  return loss.item<float>();
}

at::Tensor GeneratorStage::generated(int material, int patch_size) {
  const auto& pyramid = pictures_.pyramids[static_cast<std::size_t>(material)];
  const Size size = training_size(lesson_, pyramid[static_cast<std::size_t>(level_)], level_);
  const at::Tensor shares = shares_of(lesson_, material);
  LevelNet& net = nets_.levels[static_cast<std::size_t>(level_)];
  const at::Tensor coarser = nets_.coarser_picture(level_, batch_, size, shares);
  const at::Tensor picture =
      net->forward(coarser, noise_like(net, batch_, size), shares, Border::wraps);
  at::Tensor loss =
      sliced_distance_of_levels(picture, pyramid, level_, lesson_.recipe.directions, patch_size);
  latest_[0] = loss.item<float>();
  if (discriminators_.empty()) return loss;
  latest_[2] = train_discriminator(material, picture, coarser);
  Discriminator& discriminator = discriminators_[static_cast<std::size_t>(material)];
  for (at::Tensor& parameter : discriminator->parameters()) parameter.set_requires_grad(false);
  const at::Tensor believed = -judged(material, picture, coarser, true).mean();
  for (at::Tensor& parameter : discriminator->parameters()) parameter.set_requires_grad(true);
  latest_[1] = believed.item<float>();
  return loss + adversary_ * believed;
}

// The exemplar's own finer level, made of its own coarser one.
at::Tensor GeneratorStage::reconstructed(int material, int patch_size) {
  const auto& pyramid = pictures_.pyramids[static_cast<std::size_t>(material)];
  const at::Tensor& whole = pyramid[static_cast<std::size_t>(level_)];
  const at::Tensor larger =
      upsampled(pyramid[static_cast<std::size_t>(level_) - 1], Border::mirrors);
  // Each coarser pixel is four finer ones; an odd last row or column has no coarser one.
  const std::int64_t height = larger.size(2), width = larger.size(3);
  const std::int64_t rows = std::min<std::int64_t>(lesson_.recipe.crop, height) / 2 * 2;
  const std::int64_t columns = std::min<std::int64_t>(lesson_.recipe.crop, width) / 2 * 2;
  const auto place = [](std::int64_t free) {
    return free < 2 ? 0 : 2 * at::randint(free / 2 + 1, {1}, at::kLong).item<std::int64_t>();
  };
  const std::int64_t top = place(height - rows), left = place(width - columns);
  const auto crop = [&](const at::Tensor& picture) {
    return picture.slice(2, top, top + rows)
        .slice(3, left, left + columns)
        .contiguous(at::MemoryFormat::ChannelsLast);
  };
  LevelNet& net = nets_.levels[static_cast<std::size_t>(level_)];
  const at::Tensor exemplar = crop(whole);
  const at::Tensor picture = net->forward(
      crop(larger), noise_like(net, 1, {static_cast<int>(columns), static_cast<int>(rows)}),
      shares_of(lesson_, material), Border::mirrors);
  const at::Tensor difference = (picture - exemplar).abs().mean();
  latest_[3] = difference.item<float>();
  return reconstruction_ * difference +
         sliced_distance(picture, exemplar, lesson_.recipe.directions, patch_size, false);
}

std::vector<Term> GeneratorStage::step(int step) {
  const GeneratorRecipe& recipe = lesson_.recipe;
  torch::manual_seed(seed_of(recipe.seed, level_, step));
  const double rate = recipe.learning_rate * rate_at(step, steps_);
  set_rate(*optimiser_, rate);
  if (adversary_optimiser_) set_rate(*adversary_optimiser_, rate);
  // Materials take turns, then pictures and reconstructions, then patch sizes: each meets each.
  const int materials = static_cast<int>(pictures_.pyramids.size());
  const int material = step % materials, turn = step / materials;
  const bool reconstructs = reconstruction_ > 0 && turn % 2 == 1;
  const int round = reconstruction_ > 0 ? turn / 2 : turn;
  const auto& sizes = recipe.patch_size;
  const int patch_size = sizes[static_cast<std::size_t>(round) % sizes.size()];
  const at::Tensor loss =
      reconstructs ? reconstructed(material, patch_size) : generated(material, patch_size);
  optimiser_->zero_grad();
  loss.backward();
  torch::nn::utils::clip_grad_norm_(parameters_, 1.0);
  optimiser_->step();
  return {{"sliced", latest_[0]},
          {"adversary", latest_[1]},
          {"discriminator", latest_[2]},
          {"reconstruction", latest_[3]}};
}

void GeneratorStage::keep(Tensors& tensors) {
  train::keep(*nets_.levels[static_cast<std::size_t>(level_)], "net.", tensors);
  train::keep(*optimiser_, "optimiser.", tensors);
  tensors["latest"] = {{4}, {latest_.begin(), latest_.end()}};
  if (!adversary_optimiser_) return;
  train::keep(*adversary_optimiser_, "adversary_optimiser.", tensors);
  for (std::size_t m = 0; m < discriminators_.size(); ++m)
    train::keep(*discriminators_[m], fmt::format("discriminator{}.", m), tensors);
}

void GeneratorStage::restore(const Tensors& tensors) {
  train::restore(*nets_.levels[static_cast<std::size_t>(level_)], "net.", tensors);
  train::restore(*optimiser_, "optimiser.", tensors);
  std::copy_n(tensors.at("latest").values.begin(), latest_.size(), latest_.begin());
  if (!adversary_optimiser_) return;
  train::restore(*adversary_optimiser_, "adversary_optimiser.", tensors);
  for (std::size_t m = 0; m < discriminators_.size(); ++m)
    train::restore(*discriminators_[m], fmt::format("discriminator{}.", m), tensors);
}

}  // namespace gramloom::train
