#include "jobs/generator_lessons.h"

#include <algorithm>

#include "core/hash.h"
#include "io/image_file.h"
#include "jobs/loaded_request.h"
#include "jobs/machine.h"
#include "jobs/settings.h"
#include "learnt/generator.h"
#include "metrics/exemplar_statistics.h"
#include "train/generator_training.h"

namespace gramloom {

namespace {

const GeneratorRecipe& recipe_of(const Config& config, const Lesson& lesson) {
  return std::get<GeneratorRecipe>(config.models[lesson.model].recipe);
}

// Names of an exemplar's maps, and what the config says they are.
Json map_words(const ExemplarEntry& exemplar) {
  Json words = Json::array();
  for (const auto& [name, map] : exemplar.maps)
    words.push_back({name, value_to_json(map.kind, {}), value_to_json(map.green, {})});
  return words;
}

// What the lesson's model depends on.
Json settings_of(const Config& config, const Lesson& lesson, FileHashes& hashes) {
  Json settings{{"recipe", to_json_value(recipe_of(config, lesson))}, {"exemplars", Json::array()}};
  settings["recipe"].erase("exemplars");
  for (const std::size_t exemplar : lesson.exemplars)
    settings["exemplars"].push_back(
        {config.exemplars[exemplar].name, config.exemplars[exemplar].licence,
         exemplar_hashes(config.exemplars[exemplar], hashes), map_words(config.exemplars[exemplar]),
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
    for (const ExemplarFile& file : request.files)
      if (file.low != 0 || file.high != 1)
        throw Error("{}: a generator learns no values beyond 0 to 1 yet, '{}' has {:g} to {:g}",
                    entry.place, file.map.empty() ? "the picture" : file.map, file.low, file.high);
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
      : files_(files),
        settings_(std::move(settings)),
        colours_(lesson.description.layers.front().count) {
    for (const Image& exemplar : lesson.exemplars)
      statistics_.emplace_back(extract_channels(exemplar, 0, colours_));
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
        sum +=
            gram_distance(statistics_[m].features(),
                          random_features(components(extract_channels(pictures.back(), 0, colours_),
                                                     statistics_[m].frame())));
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
  int colours_;  // channels of the picture but for its alpha
  std::vector<ExemplarStatistics> statistics_;
};

}  // namespace

void train_generator_lesson(const LessonRun& run) {
  const Json settings = settings_of(run.config, run.lesson, run.hashes);
  const std::string identity = hash_of(to_text(settings) + std::string(version()));
  if (is_trained_before(run, identity)) return;
  const GeneratorLesson loaded = load_lesson(run.config, run.lesson, run.hashes);
  refuse_without_memory(estimate_training(loaded), "a smaller crop or batch needs less");
  StateJudge judge(loaded, run.files, settings);
  const double seconds = run_training(run, identity, [&](const Control& control) {
    write_generator(model_of(run.files), train_generator(loaded, control, std::ref(judge)),
                    {{"identity", identity}});
  });
  run.bar.message(fmt::format("{}: trained in {}", run.lesson.name, clock_text(seconds)));
}

Cost estimate_generator_lesson(const Config& config, const Lesson& lesson) {
  FileHashes hashes;
  return estimate_training(load_lesson(config, lesson, hashes));
}

std::vector<MethodEntry> methods_of_generator(const Config& config, const Lesson& lesson,
                                              const JobFiles& files) {
  std::vector<MethodEntry> methods;
  for (std::size_t m = 0; m < lesson.exemplars.size(); ++m) {
    GeneratorParams params;
    params.model = model_of(files);
    params.exemplar = config.exemplars[lesson.exemplars[m]].name;
    if (lesson.exemplars.size() > 1)
      for (const float share : alone(m, lesson.exemplars.size())) params.weights.push_back(share);
    methods.push_back(
        {config.models[lesson.model].name, params, config.models[lesson.model].place});
  }
  return methods;
}

}  // namespace gramloom
