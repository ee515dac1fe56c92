// The whole training of a generator, level by level.
#include <chrono>
#include <limits>

#include "io/safetensors.h"
#include "neural/openmp.h"
#include "train/finite_loss.h"
#include "train/generator_stage.h"
#include "train/train_module.h"

namespace gramloom::train {

namespace {

namespace fs = std::filesystem;

// A training under way.
struct Training {
  const GeneratorLesson& lesson;
  const Control& control;
  const Judge& judge;
  LessonPictures pictures = {};
  GeneratorModel model = {};
  GeneratorNets nets = {};
  int total = 0;      // steps of all levels
  int level = 0;      // under training
  int next_step = 0;  // of that level
  double best_score = std::numeric_limits<double>::infinity();
  int best_step = 0;
  std::map<std::string, TensorData> best = {};
  Discriminators discriminators = {};  // of the level before
  std::optional<Tensors> saved = {};   // of the stage to go on with
};

// The model's tensors of the nets as they are.
void take_tensors(const GeneratorNets& nets, GeneratorModel& model) {
  for (std::size_t k = 0; k < nets.levels.size(); ++k)
    keep(*nets.levels[k], fmt::format("levels.{}.", k), model.tensors);
}

int steps_before(const GeneratorRecipe& recipe, int level) {
  int steps = 0;
  for (int k = 0; k < level; ++k) steps += at_level(recipe.steps, k);
  return steps;
}

constexpr const char* best_prefix = "best.";
constexpr const char* model_prefix = "model.";

void write_state(const Training& training, GeneratorStage& stage) {
  if (training.control.checkpoint.empty()) return;
  Tensors tensors;
  for (const auto& [name, tensor] : training.model.tensors) tensors[model_prefix + name] = tensor;
  for (const auto& [name, tensor] : training.best) tensors[best_prefix + name] = tensor;
  stage.keep(tensors);
  write_tensors(training.control.checkpoint, tensors,
                {{"identity", training.control.identity},
                 {"level", fmt::format("{}", training.level)},
                 {"step", fmt::format("{}", training.next_step)},
                 {"best", fmt::format("{}", training.best_score)},
                 {"best_step", fmt::format("{}", training.best_step)}});
}

// Goes on from a checkpoint of the same work; one that is damaged, or of other work, is not used.
void read_state(Training& training) {
  const fs::path& file = training.control.checkpoint;
  std::error_code ignored;
  if (file.empty() || !fs::exists(file, ignored)) return;
  try {
    const auto metadata = read_metadata(file);
    if (metadata.at("identity") != training.control.identity) return;
    Tensors tensors = read_tensors(file);
    const int level = std::stoi(metadata.at("level"));
    for (const auto& [name, tensor] : tensors) {
      if (name.starts_with(model_prefix))
        training.model.tensors[name.substr(std::string_view(model_prefix).size())] = tensor;
      if (name.starts_with(best_prefix))
        training.best[name.substr(std::string_view(best_prefix).size())] = tensor;
    }
    for (int k = 0; k < level; ++k)
      restore(*training.nets.levels[static_cast<std::size_t>(k)], fmt::format("levels.{}.", k),
              training.model.tensors);
    training.level = level;
    training.next_step = std::stoi(metadata.at("step"));
    training.best_score = std::stod(metadata.at("best"));
    training.best_step = std::stoi(metadata.at("best_step"));
    training.saved = std::move(tensors);
  } catch (const std::exception&) {
    training.saved.reset();
  }
}

// Shows a state to the judge; of the finest level the best is kept.
void look(Training& training, int done) {
  const int to_come = training.model.level_count() - 1 - training.level;
  take_tensors(training.nets, training.model);
  if (!training.judge) return;
  GeneratorModel shown = training.model;
  shown.description.levels.resize(static_cast<std::size_t>(training.level) + 1);
  std::erase_if(shown.tensors, [&](const auto& tensor) {
    return !tensor_shapes(shown.description).contains(tensor.first);
  });
  const double score = training.judge({shown, done, training.total, to_come});
  if (to_come > 0 || !(score < training.best_score)) return;
  training.best_score = score;
  training.best_step = done;
  training.best = shown.tensors;
}

void train_level(Training& training) {
  GeneratorStage stage(training.lesson, training.pictures, training.nets, training.level,
                       training.discriminators);
  if (training.saved) stage.restore(*training.saved);
  training.saved.reset();
  const int before = steps_before(training.lesson.recipe, training.level);
  auto kept_at = std::chrono::steady_clock::now();
  while (training.next_step < stage.steps()) {
    Progress progress;
    progress.terms = stage.step(training.next_step);
    ++training.next_step;
    progress.step = before + training.next_step;
    progress.steps = training.total;
    progress.evaluations = progress.step;
    progress.loss = progress.terms.front().value;
    check_finite_loss(progress);
    const bool last = training.next_step == stage.steps();
    if (last || progress.step % training.lesson.recipe.sample_every == 0)
      stage.with_means([&] { look(training, static_cast<int>(progress.step)); });
    const bool goes_on = training.control.report(progress);
    const auto now = std::chrono::steady_clock::now();
    if (goes_on && (last || now - kept_at < std::chrono::minutes(1))) continue;
    kept_at = now;
    take_tensors(training.nets, training.model);
    write_state(training, stage);
    if (!goes_on) throw Interrupted();
  }
  stage.take_means();
  take_tensors(training.nets, training.model);
  training.discriminators = stage.discriminators();
  training.next_step = 0;
}

}  // namespace

GeneratorModel run_generator_training(const GeneratorLesson& lesson, const Control& control,
                                      const Judge& judge) {
  neural::start_openmp();
  torch::manual_seed(static_cast<std::uint64_t>(lesson.recipe.seed));
  Training training{.lesson = lesson, .control = control, .judge = judge};
  training.model.description = lesson.description;
  const int levels = training.model.level_count();
  training.pictures = lesson_pictures(lesson, levels);
  add_colours(training.pictures, lesson.exemplars, training.model);
  for (int k = 0; k < levels; ++k) training.nets.levels.emplace_back(lesson.description, k);
  training.total = steps_before(lesson.recipe, levels);
  read_state(training);
  for (; training.level < levels; ++training.level) train_level(training);
  if (!training.best.empty()) {
    training.model.tensors = std::move(training.best);
    training.model.description.scores = {{"judged", training.best_score},
                                         {"step", training.best_step}};
  }
  return std::move(training.model);
}

}  // namespace gramloom::train
