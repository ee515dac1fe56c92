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

// Of the first group of parameters; the second, if there is one, has a share of it.
void set_rate(torch::optim::Adam& optimiser, double rate, double second_share) {
  double share = 1;
  for (auto& group : optimiser.param_groups()) {
    static_cast<torch::optim::AdamOptions&>(group.options()).lr(rate * share);
    share = second_share;
  }
}

torch::optim::AdamOptions adam_options(double rate, double first_beta) {
  return torch::optim::AdamOptions(rate).betas({first_beta, 0.99});
}

// Weights lie as oneDNN reads them.
void use_channels_last(torch::nn::Module& module) {
  for (at::Tensor& parameter : module.parameters())
    if (parameter.dim() == 4)
      parameter.set_data(parameter.detach().contiguous(at::MemoryFormat::ChannelsLast));
}

// A level's pictures in training: at most `crop` a side, and whole on the coarsest level.
Size training_size(const GeneratorLesson& lesson, const at::Tensor& exemplar, int level) {
  const auto side = [&](std::int64_t length) {
    const int longest = std::min(at_level(lesson.recipe.crop, level), static_cast<int>(length));
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
         static_cast<std::uint64_t>(level) * 10'000'019u + static_cast<std::uint64_t>(step + 1);
}

void set_trainable(torch::nn::Module& module, bool trainable) {
  for (at::Tensor& parameter : module.parameters()) parameter.set_requires_grad(trainable);
}

// Not zero: what has no part in a step stays as it is, whatever momentum it has, and so after a
// resume too.
void forget_gradients(torch::optim::Adam& optimiser) {
  for (auto& group : optimiser.param_groups())
    for (at::Tensor& parameter : group.params()) parameter.mutable_grad() = at::Tensor();
}

bool same_shape(const Discriminator& a, const Discriminator& b) {
  const auto of_a = a->parameters(), of_b = b->parameters();
  return std::equal(
      of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
      [](const at::Tensor& x, const at::Tensor& y) { return x.sizes() == y.sizes(); });
}

}  // namespace

at::Tensor noise_like(const LevelNet& net, int batch, Size size) {
  const at::Tensor uniform = at::rand({batch, net->noise_channels, size.height, size.width});
  return ((uniform - 0.5) * std::sqrt(12.0)).contiguous(at::MemoryFormat::ChannelsLast);
}

LevelPictures GeneratorNets::pictures(int level, int first, int batch, Size size,
                                      const at::Tensor& shares) {
  LevelPictures made;
  for (int k = 0; k <= level; ++k) {
    const torch::AutoGradMode gradients(torch::GradMode::is_enabled() && k >= first);
    const Size own{size.width >> (level - k), size.height >> (level - k)};
    LevelNet& net = levels[static_cast<std::size_t>(k)];
    if (k > 0) made.coarser = upsampled(made.picture, Border::wraps);
    made.picture = net->forward(made.coarser, noise_like(net, batch, own), shares, Border::wraps);
  }
  return made;
}

GeneratorStage::GeneratorStage(const GeneratorLesson& lesson, const LessonPictures& pictures,
                               GeneratorNets& nets, int level, const Discriminators& before)
    : lesson_(lesson),
      nets_(nets),
      pyramids_(pictures.pyramids),
      level_(level),
      first_(level > 0 && lesson.recipe.coarser_rate > 0 ? level - 1 : level),
      steps_(at_level(lesson.recipe.steps, level)),
      batch_(at_level(lesson.recipe.batch, level)),
      sees_coarser_(level > 0 && level + 1 == static_cast<int>(nets.levels.size())),
      adversary_(at_level(lesson.recipe.adversary, level)),
      reconstruction_(level == 0 ? 0 : at_level(lesson.recipe.reconstruction, level)) {
  const GeneratorRecipe& recipe = lesson.recipe;
  torch::manual_seed(seed_of(recipe.seed, level, -1));
  std::vector<torch::optim::OptimizerParamGroup> groups;
  for (int k = level; k >= first_; --k) {
    LevelNet& net = nets.levels[static_cast<std::size_t>(k)];
    use_channels_last(*net);
    groups.emplace_back(net->parameters());
    for (const at::Tensor& parameter : net->parameters()) parameters_.push_back(parameter);
  }
  for (const at::Tensor& parameter : parameters_) means_.push_back(parameter.detach().clone());
  optimiser_ = std::make_unique<torch::optim::Adam>(
      groups, adam_options(recipe.learning_rate, adversary_ > 0 ? 0.5 : 0.9));
  if (adversary_ == 0) return;
  std::vector<at::Tensor> all;
  for (std::size_t m = 0; m < pyramids_.size(); ++m) {
    Discriminator discriminator(pictures.axes.channels * (sees_coarser_ ? 2 : 1),
                                at_level(recipe.adversary_hidden, level),
                                at_level(recipe.adversary_layers, level));
    if (m < before.size() && same_shape(before[m], discriminator)) {
      Tensors tensors;
      train::keep(*before[m], "", tensors);
      train::restore(*discriminator, "", tensors);
    }
    use_channels_last(*discriminator);
    for (const at::Tensor& parameter : discriminator->parameters()) all.push_back(parameter);
    discriminators_.push_back(std::move(discriminator));
  }
  adversary_optimiser_ =
      std::make_unique<torch::optim::Adam>(all, adam_options(recipe.learning_rate, 0.5));
}

at::Tensor GeneratorStage::judged(int material, const LevelPictures& pictures, bool wraps) const {
  Discriminator discriminator = discriminators_[static_cast<std::size_t>(material)];
  const at::Tensor seen = sees_coarser_
                              ? at::cat({pictures.picture - pictures.coarser, pictures.coarser}, 1)
                              : pictures.picture;
  return discriminator->forward(seen, wraps);
}

// Trains the discriminator by the hinge loss, what is real to be above 1, what is made below −1;
// then how little it believes what is made.
at::Tensor GeneratorStage::believed(int material, const LevelPictures& made,
                                    const LevelPictures& real, bool wraps) {
  Discriminator& discriminator = discriminators_[static_cast<std::size_t>(material)];
  const LevelPictures fixed{made.picture.detach(),
                            made.coarser.defined() ? made.coarser.detach() : made.coarser};
  const at::Tensor loss = at::relu(1 - judged(material, real, false)).mean() +
                          at::relu(1 + judged(material, fixed, wraps)).mean();
  forget_gradients(*adversary_optimiser_);
  loss.backward();
  adversary_optimiser_->step();
  latest_[2] = loss.item<float>();
  set_trainable(*discriminator, false);
  const at::Tensor doubt = -judged(material, made, wraps).mean();
  set_trainable(*discriminator, true);
  latest_[1] = doubt.item<float>();
  return doubt;
}

// Of the level, and half as much of the next coarser one. Not pooled: each picture by itself.
at::Tensor GeneratorStage::distance(const at::Tensor& pictures,
                                    const std::vector<at::Tensor>& pyramid, int patch_size,
                                    bool pooled) const {
  const auto level = static_cast<std::size_t>(level_);
  const int directions = lesson_.recipe.directions;
  const auto of = [&](const at::Tensor& some, int count) {
    at::Tensor sum = sliced_distance(some, pyramid[level], count, patch_size, true);
    if (level_ > 0)
      sum = sum + 0.5 * sliced_distance(at::avg_pool2d(some, 2), pyramid[level - 1],
                                        std::max(1, directions / 2), patch_size, true);
    return sum;
  };
  if (pooled || pictures.size(0) == 1) return of(pictures, directions);
  at::Tensor sum = at::zeros({});
  const auto count = static_cast<int>(pictures.size(0));
  for (int i = 0; i < count; ++i)
    sum = sum + of(pictures.slice(0, i, i + 1), std::max(12, directions / count));
  return sum / count;
}

// A part of the exemplar's level, as large as a picture in training, and its coarser level there.
LevelPictures GeneratorStage::part_of_exemplar(const std::vector<at::Tensor>& pyramid) const {
  const at::Tensor& whole = pyramid[static_cast<std::size_t>(level_)];
  if (level_ == 0) return {whole, {}};
  const at::Tensor larger =
      upsampled(pyramid[static_cast<std::size_t>(level_) - 1], Border::mirrors);
  // Each coarser pixel is four finer ones; an odd last row or column has no coarser one.
  const std::int64_t crop = at_level(lesson_.recipe.crop, level_);
  const std::int64_t rows = std::min(crop, larger.size(2)) / 2 * 2;
  const std::int64_t columns = std::min(crop, larger.size(3)) / 2 * 2;
  const auto place = [](std::int64_t free) -> std::int64_t {
    return free < 2 ? 0 : 2 * at::randint(free / 2 + 1, {1}, at::kLong).item<std::int64_t>();
  };
  const std::int64_t top = place(larger.size(2) - rows), left = place(larger.size(3) - columns);
  const auto cut = [&](const at::Tensor& picture) {
    return picture.slice(2, top, top + rows)
        .slice(3, left, left + columns)
        .contiguous(at::MemoryFormat::ChannelsLast);
  };
  return {cut(whole), cut(larger)};
}

at::Tensor GeneratorStage::generated(int material, int patch_size, bool pooled) {
  const auto& pyramid = pyramids_[static_cast<std::size_t>(material)];
  const Size size = training_size(lesson_, pyramid[static_cast<std::size_t>(level_)], level_);
  const LevelPictures made =
      nets_.pictures(level_, first_, batch_, size, shares_of(lesson_, material));
  const at::Tensor loss = distance(made.picture, pyramid, patch_size, pooled);
  latest_[0] = loss.item<float>();
  if (discriminators_.empty()) return loss;
  return loss + adversary_ * believed(material, made, part_of_exemplar(pyramid), true);
}

// The exemplar's own finer level, made of its own coarser one.
at::Tensor GeneratorStage::reconstructed(int material, int patch_size) {
  const auto& pyramid = pyramids_[static_cast<std::size_t>(material)];
  const LevelPictures real = part_of_exemplar(pyramid);
  const Size size{static_cast<int>(real.picture.size(3)), static_cast<int>(real.picture.size(2))};
  LevelNet& net = nets_.levels[static_cast<std::size_t>(level_)];
  const LevelPictures made{net->forward(real.coarser, noise_like(net, 1, size),
                                        shares_of(lesson_, material), Border::mirrors),
                           real.coarser};
  const at::Tensor difference = (made.picture - real.picture).abs().mean();
  latest_[3] = difference.item<float>();
  const at::Tensor loss =
      reconstruction_ * difference +
      sliced_distance(made.picture, real.picture, lesson_.recipe.directions, patch_size, false);
  if (discriminators_.empty()) return loss;
  return loss + adversary_ * believed(material, made, real, false);
}

std::vector<Term> GeneratorStage::step(int step) {
  const GeneratorRecipe& recipe = lesson_.recipe;
  torch::manual_seed(seed_of(recipe.seed, level_, step));
  const double rate = recipe.learning_rate * rate_at(step, steps_);
  set_rate(*optimiser_, rate, recipe.coarser_rate);
  if (adversary_optimiser_) set_rate(*adversary_optimiser_, rate, 1);
  // Materials take turns, then pictures and reconstructions, then patch sizes, then pooling: each
  // meets each.
  const int materials = static_cast<int>(pyramids_.size());
  const int material = step % materials, turn = step / materials;
  const int round = turn / 2;
  const auto& sizes = recipe.patch_size;
  const int patch_size = sizes[static_cast<std::size_t>(round) % sizes.size()];
  const bool pooled = round / static_cast<int>(sizes.size()) % 2 == 0;
  const bool reconstructs = reconstruction_ > 0 && turn % 2 == 1;
  const at::Tensor loss =
      reconstructs ? reconstructed(material, patch_size) : generated(material, patch_size, pooled);
  forget_gradients(*optimiser_);
  loss.backward();
  torch::nn::utils::clip_grad_norm_(parameters_, 1.0);
  optimiser_->step();
  update_means(step);
  return {{"sliced", latest_[0]},
          {"adversary", latest_[1]},
          {"discriminator", latest_[2]},
          {"reconstruction", latest_[3]}};
}

void GeneratorStage::update_means(int step) {
  const torch::NoGradGuard no_gradients;
  const double decay = std::min(0.99, (1.0 + step) / (10.0 + step));
  for (std::size_t i = 0; i < means_.size(); ++i)
    means_[i].mul_(decay).add_(parameters_[i], 1 - decay);
}

void GeneratorStage::with_means(const std::function<void()>& work) {
  std::vector<at::Tensor> own;
  for (std::size_t i = 0; i < means_.size(); ++i) {
    own.push_back(parameters_[i].detach());
    parameters_[i].set_data(means_[i]);
  }
  work();
  for (std::size_t i = 0; i < means_.size(); ++i) parameters_[i].set_data(own[i]);
}

void GeneratorStage::take_means() {
  const torch::NoGradGuard no_gradients;
  for (std::size_t i = 0; i < means_.size(); ++i) parameters_[i].copy_(means_[i]);
}

void GeneratorStage::keep(Tensors& tensors) {
  train::keep(*nets_.levels[static_cast<std::size_t>(level_)], "net.", tensors);
  train::keep(*optimiser_, "optimiser.", tensors);
  tensors["latest"] = {{4}, {latest_.begin(), latest_.end()}};
  for (std::size_t i = 0; i < means_.size(); ++i)
    tensors[fmt::format("mean{}", i)] = to_data(means_[i]);
  if (!adversary_optimiser_) return;
  train::keep(*adversary_optimiser_, "adversary_optimiser.", tensors);
  for (std::size_t m = 0; m < discriminators_.size(); ++m)
    train::keep(*discriminators_[m], fmt::format("discriminator{}.", m), tensors);
}

void GeneratorStage::restore(const Tensors& tensors) {
  train::restore(*nets_.levels[static_cast<std::size_t>(level_)], "net.", tensors);
  train::restore(*optimiser_, "optimiser.", tensors);
  std::copy_n(tensors.at("latest").values.begin(), latest_.size(), latest_.begin());
  for (std::size_t i = 0; i < means_.size(); ++i)
    means_[i].copy_(to_tensor(tensors, fmt::format("mean{}", i), means_[i].sizes()));
  if (!adversary_optimiser_) return;
  train::restore(*adversary_optimiser_, "adversary_optimiser.", tensors);
  for (std::size_t m = 0; m < discriminators_.size(); ++m)
    train::restore(*discriminators_[m], fmt::format("discriminator{}.", m), tensors);
}

}  // namespace gramloom::train
