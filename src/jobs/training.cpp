#include "jobs/training.h"

#include <algorithm>
#include <chrono>

#include "core/hash.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "jobs/folder_lock.h"
#include "jobs/inputs.h"
#include "jobs/loaded_request.h"
#include "jobs/machine.h"
#include "jobs/memory.h"
#include "jobs/output_guard.h"
#include "jobs/results.h"
#include "jobs/settings.h"
#include "jobs/trace_log.h"
#include "learnt/generator.h"
#include "learnt/model_file.h"
#include "metrics/exemplar_statistics.h"
#include "runs/job_files.h"
#include "train/generator_training.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

const GeneratorRecipe& recipe_of(const Config& config, const Lesson& lesson) {
  return std::get<GeneratorRecipe>(config.models[lesson.model].recipe);
}

// What the lesson's model depends on.
Json settings_of(const Config& config, const Lesson& lesson, FileHashes& hashes) {
  Json settings{{"recipe", to_json_value(recipe_of(config, lesson))}, {"exemplars", Json::array()}};
  settings["recipe"].erase("exemplars");
  for (const std::size_t exemplar : lesson.exemplars)
    settings["exemplars"].push_back({config.exemplars[exemplar].name,
                                     exemplar_hashes(config.exemplars[exemplar], hashes),
                                     value_to_json(config.exemplars[exemplar].max_side, {})});
  return settings;
}

// The exemplars of a lesson, and the description that its model begins with.
GeneratorLesson load_lesson(const Config& config, const Lesson& lesson, FileHashes& hashes) {
  GeneratorLesson loaded{recipe_of(config, lesson), {}, {}};
  std::vector<Layer> layers;
  for (const std::size_t number : lesson.exemplars) {
    const ExemplarEntry& entry = config.exemplars[number];
    LoadedRequest request = load_request(config, number);
    if (request.exemplars.size() != 1)
      throw Error("{}: a generator learns exemplars of one picture each", entry.place);
    Exemplar& exemplar = request.exemplars.front();
    check_picture(exemplar.image);
    if (!exemplar.mask.empty() || !exemplar.guide.empty())
      throw Error("{}: a generator learns no masks and no guides yet", entry.place);
    const std::vector<Layer> own = layers_of(request.files);
    if (!layers.empty() && own != layers)
      throw Error("{}: its channels and maps are not those of the other exemplars", entry.place);
    layers = own;
    std::string all;
    for (const std::string& hash : exemplar_hashes(entry, hashes)) all += hash;
    loaded.exemplars.push_back(std::move(exemplar.image));
    loaded.description.materials.push_back({entry.name, hash_of(all), entry.licence});
  }
  for (const Layer& layer : layers)
    loaded.description.layers.push_back(
        {layer.name, layer.kind, layer.first, layer.count, layer.green});
  return loaded;
}

// Shares of one material alone.
std::vector<float> alone(std::size_t material, std::size_t materials) {
  std::vector<float> shares(materials, 0.0f);
  shares[material] = 1;
  return shares;
}

// Makes a picture of every state, keeps it, and tells how far it is from the exemplars: the mean
// distance of features of a random network that no training sees.
class StateJudge {
 public:
  StateJudge(const GeneratorLesson& lesson, const JobFiles& files, Json settings)
      : files_(files), settings_(std::move(settings)) {
    for (const Image& exemplar : lesson.exemplars)
      statistics_.emplace_back(
          extract_channels(exemplar, 0, lesson.description.layers.front().count));
  }

  double operator()(const TrainingState& state) {
    double sum = 0;
    const std::size_t count = statistics_.size();
    std::vector<Image> pictures;
    for (std::size_t m = 0; m < count; ++m) {
      const int unit = 1 << (state.levels_to_come);
      const Size size = statistics_[m].exemplar().size();
      const Generation wanted{{std::max(1, std::min(256, size.width) / unit),
                               std::max(1, std::min(256, size.height) / unit)},
                              Tile::both,
                              1,
                              alone(m, count),
                              {}};
      pictures.push_back(
          split_generated(generate(state.model, wanted, {}), state.model.description).image);
      if (state.levels_to_come == 0)
        sum += gram_distance(statistics_[m].features(),
                             random_features(components(pictures.back(), statistics_[m].frame())));
    }
    keep(pictures, state.step);
    return sum / static_cast<double>(count);
  }

 private:
  // All pictures of a state side by side.
  void keep(const std::vector<Image>& pictures, int step) const {
    int width = 0, height = 0;
    for (const Image& picture : pictures) {
      width += picture.width;
      height = std::max(height, picture.height);
    }
    Image sheet(width, height, pictures.front().channels);
    int left = 0;
    for (const Image& picture : pictures) {
      for (int y = 0; y < picture.height; ++y)
        std::copy_n(picture.at(0, y), static_cast<std::size_t>(picture.width * picture.channels),
                    sheet.at(left, y));
      left += picture.width;
    }
    write_image(files_.folder / fmt::format("{}_{:06}.png", files_.name, step), sheet, {},
                {{"gramloom:settings", to_text(settings_, -1, true)}});
  }

  const JobFiles& files_;
  Json settings_;
  std::vector<ExemplarStatistics> statistics_;
};

// A lesson's model, and its identity when it is finished.
fs::path model_of(const JobFiles& files) { return files.folder / (files.name + ".safetensors"); }

bool is_trained(const fs::path& model, const std::string& identity) {
  std::error_code ignored;
  if (!fs::exists(model, ignored)) return false;
  try {
    const auto metadata = read_metadata(model);
    const auto found = metadata.find("identity");
    return found != metadata.end() && found->second == identity;
  } catch (const Error&) {
    return false;
  }
}

// Throws Error when training would replace a file that is no model of ours.
void check_replaced_model(const fs::path& model) {
  std::error_code ignored;
  if (!fs::exists(model, ignored)) return;
  try {
    model_kind(model);
  } catch (const Error&) {
    throw ConfigError("would replace {}, which no training of gramloom made",
                      model.lexically_normal().string());
  }
}

void train(const Config& config, const Lesson& lesson, const RunOptions& options, ProgressBar& bar,
           const JobFiles& files, FileHashes& hashes) {
  const Json settings = settings_of(config, lesson, hashes);
  const std::string identity = hash_of(to_text(settings) + std::string(version()));
  if (options.resume && is_trained(model_of(files), identity)) {
    bar.message(fmt::format("{}: trained before", lesson.name));
    return;
  }
  const GeneratorLesson loaded = load_lesson(config, lesson, hashes);
  const Cost cost = estimate_training(loaded);
  if (cost.bytes > available_memory())
    throw Error(
        "training needs about {:.1f} GB of memory, {:.1f} GB are free; a smaller crop or batch "
        "needs less",
        cost.bytes / 1e9, available_memory() / 1e9);
  TraceLog trace(files.checkpoint_trace, identity);
  if (!options.resume || !trace.continues() || !fs::exists(files.checkpoint)) {
    trace.restart();
    remove_file(files.checkpoint);
  }
  Control control;
  control.checkpoint = files.checkpoint;
  control.identity = identity;
  control.progress = [&](const Progress& progress) {
    trace.add(progress);
    bar.update(progress);
    return !(options.stop && options.stop());
  };
  StateJudge judge(loaded, files, settings);
  const GeneratorModel model = train_generator(loaded, control, std::ref(judge));
  write_generator(model_of(files), model, {{"identity", identity}});
  write_text(files.trace, to_csv(trace.trace()));
  remove_unfinished_state(files);
  bar.message(fmt::format("{}: trained in {}", lesson.name, clock_text(trace.seconds())));
}

}  // namespace

std::vector<Lesson> lessons_of(const Config& config) {
  std::vector<Lesson> lessons;
  for (std::size_t m = 0; m < config.models.size(); ++m) {
    if (!std::holds_alternative<GeneratorRecipe>(config.models[m].recipe)) continue;
    const auto& recipe = std::get<GeneratorRecipe>(config.models[m].recipe);
    std::vector<std::size_t> wanted;
    for (std::size_t e = 0; e < config.exemplars.size(); ++e)
      if (recipe.exemplars.empty() ||
          std::ranges::count(recipe.exemplars, config.exemplars[e].name))
        wanted.push_back(e);
    const std::string& name = config.models[m].name;
    if (recipe.blend)
      lessons.push_back({m, wanted, name});
    else
      for (const std::size_t e : wanted)
        lessons.push_back({m, {e}, fmt::format("{}_{}", config.exemplars[e].name, name)});
  }
  return lessons;
}

Trained train_models(const Config& config, const RunOptions& options, ProgressBar& bar) {
  Trained trained;
  const std::vector<Lesson> lessons = lessons_of(config);
  const fs::path folder = options.output / "models";
  std::optional<FolderLock> lock;
  try {
    create_folder(folder);
    lock.emplace(options.output);
    if (options.is_default_output) check_default_output(config, options.output);
    for (const Lesson& lesson : lessons)
      check_replaced_model(model_of(job_files(options.output, "models/" + lesson.name)));
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", options.output.string(), error.what());
  }
  FileHashes hashes;
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const Lesson& lesson = lessons[i];
    const JobFiles files = job_files(options.output, "models/" + lesson.name);
    bar.start("training " + lesson.name, i + 1, lessons.size());
    try {
      train(config, lesson, options, bar, files, hashes);
    } catch (const Interrupted&) {
      trained.interrupted = true;
      return trained;
    } catch (const ConfigError&) {
      throw;
    } catch (const std::bad_alloc&) {
      ++trained.failed;
      bar.complaint(fmt::format("{}: failed: out of memory", lesson.name));
      continue;
    } catch (const std::exception& error) {
      ++trained.failed;
      bar.complaint(fmt::format("{}: failed: {}", lesson.name, first_line(error.what())));
      continue;
    }
    for (std::size_t m = 0; m < lesson.exemplars.size(); ++m) {
      GeneratorParams params;
      params.model = model_of(files);
      params.exemplar = config.exemplars[lesson.exemplars[m]].name;
      if (lesson.exemplars.size() > 1)
        for (const float share : alone(m, lesson.exemplars.size())) params.weights.push_back(share);
      trained.methods.push_back(
          {config.models[lesson.model].name, params, config.models[lesson.model].place});
    }
  }
  return trained;
}

}  // namespace gramloom
