#include "jobs/inference_lessons.h"

#include <algorithm>

#include "core/hash.h"
#include "io/image_file.h"
#include "jobs/infer_pictures.h"
#include "jobs/inference_pairs.h"
#include "jobs/machine.h"
#include "jobs/pose_blends.h"
#include "jobs/simulation.h"
#include "runs/frames.h"
#include "train/inference_training.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What has no trace and no checkpoint.
Control shown_by(const LessonRun& run) {
  Control control;
  control.progress = [&](const Progress& progress) {
    run.bar.update(progress);
    return !(run.options.stop && run.options.stop());
  };
  return control;
}

// The table of the pairs, whose pictures are simulated if need be.
fs::path table_of(const LessonRun& run, const InferenceRecipe& recipe) {
  if (recipe.simulation.empty()) return recipe.pairs;
  const Simulation simulation = read_simulation(recipe.simulation);
  const fs::path folder = run.options.output / "data" / run.lesson.name;
  if (run.options.resume && is_simulated(simulation, folder)) return folder / "poses.csv";
  return make_simulation(simulation, folder, shown_by(run));
}

// The poses of that table, before anything is simulated.
PoseTable planned_poses(const InferenceRecipe& recipe) {
  if (recipe.simulation.empty()) return read_pose_table(recipe.pairs);
  return parse_pose_table(pose_table(read_simulation(recipe.simulation)), recipe.simulation);
}

std::vector<fs::path> frames_of(const FrameSequence& sequence, const JobFiles& files) {
  return frame_files(files.folder / (files.name + "_frames"),
                     static_cast<std::size_t>(sequence.frames), "exr");
}

// Pairs by what becomes of them.
struct Pairs {
  InferencePairs learnt, chosen_by, tested;
};

InferenceLesson lesson_of(const InferenceRecipe& recipe, const Pairs& pairs) {
  InferenceLesson lesson{recipe, pairs.learnt.poses, pairs.learnt.pictures, {}};
  // The model says what it learnt, and not where that was.
  lesson.recipe.pairs = recipe.pairs.filename();
  lesson.recipe.simulation = recipe.simulation.filename();
  lesson.description.pose = pairs.learnt.numbers;
  lesson.description.pixel_type = pairs.learnt.pixel_type;
  lesson.description.values = pairs.learnt.values;
  lesson.description.hash = pairs.learnt.hash;
  return lesson;
}

PairsSize size_of(const PairSplit& split, std::size_t numbers, Size size, int channels) {
  return {static_cast<int>(numbers), size, channels, split.learnt.size(), split.chosen_by.size(),
          split.tested.size()};
}

// Pictures in rows, all from one range of values; of more channels than a PNG has, the first.
void write_sheet(const fs::path& file, const std::vector<std::vector<Image>>& rows,
                 const Metadata& metadata) {
  const Image& first = rows.front().front();
  const int channels = first.channels == 2 || first.channels > 4 ? 1 : first.channels;
  const auto columns = static_cast<int>(std::min<std::size_t>(rows.front().size(), 8));
  const ChannelRange range = [&] {
    ChannelRange all = channel_range(first);
    for (const Image& picture : rows.front()) {
      const ChannelRange own = channel_range(picture);
      for (std::size_t c = 0; c < own.low.size(); ++c) {
        all.low[c] = std::min(all.low[c], own.low[c]);
        all.high[c] = std::max(all.high[c], own.high[c]);
      }
    }
    return all;
  }();
  constexpr int gap = 2;
  const int wide = first.width + gap, high = first.height + gap;
  Image sheet(columns * wide - gap, static_cast<int>(rows.size()) * high - gap, channels, 1.0f);
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (int column = 0; column < columns; ++column) {
      const Image& picture = rows[row][static_cast<std::size_t>(column)];
      for (int y = 0; y < first.height; ++y)
        for (int x = 0; x < first.width; ++x)
          for (int c = 0; c < channels; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            const float width = range.high[channel] - range.low[channel];
            sheet.at(column * wide + x, static_cast<int>(row) * high + y)[c] =
                width > 0
                    ? std::clamp((picture.at(x, y)[c] - range.low[channel]) / width, 0.0f, 1.0f)
                    : 0.5f;
          }
    }
  write_image(file, sheet, {}, metadata);
}

std::vector<Image> inferred(const InferenceModel& model, const InferencePairs& pairs) {
  std::vector<Image> pictures;
  for (const auto& pose : pairs.poses) pictures.push_back(infer(model, pose));
  return pictures;
}

// The errors of the trained model, and a sheet: the truth, what is inferred, the nearest pair and
// the blend. Returns what is to be said of them.
std::string measure(const LessonRun& run, const Pairs& pairs, const Metadata& metadata,
                    InferenceModel& model) {
  const InferencePairs& tested = pairs.tested;
  const Image mean = mean_picture(pairs.learnt.pictures);
  const PoseBlend blend = best_blend(pairs.learnt, pairs.chosen_by);
  const std::vector<Image> made = inferred(model, tested);
  std::vector<Image> nearest, blended;
  for (const auto& pose : tested.poses) {
    nearest.push_back(nearest_picture(pairs.learnt, pose));
    blended.push_back(blended_picture(pairs.learnt, blend, pose));
  }
  const auto error = [&](const std::vector<Image>& pictures) {
    return relative_error(pictures, tested.pictures, mean);
  };
  InferenceErrors& errors = model.description.errors;
  errors = {static_cast<int>(pairs.learnt.poses.size()),
            static_cast<int>(pairs.chosen_by.poses.size()),
            static_cast<int>(tested.poses.size()),
            error(made),
            error(nearest),
            error(blended)};
  write_sheet(run.files.folder / (run.files.name + "_held_out.png"),
              {tested.pictures, made, nearest, blended}, metadata);
  return fmt::format(
      "relative error on {} held-out pairs: {:.3f}; of the nearest pair {:.3f}, of a blend {:.3f} "
      "({})",
      errors.tested, errors.network, errors.nearest, errors.blend, blend.text());
}

void learn(const LessonRun& run, const InferenceRecipe& recipe) {
  const InferencePairs all = read_pairs(table_of(run, recipe), run.hashes);
  Json settings{{"recipe", to_json_value(recipe)}, {"pairs", all.hash}};
  for (const char* file : {"pairs", "simulation"}) settings["recipe"].erase(file);
  const std::string identity = hash_of(to_text(settings) + std::string(version()));
  if (is_trained_before(run, identity)) return;
  const PairSplit split = split_pairs(all.poses.size(), recipe.held_out, recipe.seed);
  const Pairs pairs{select_pairs(all, split.learnt), select_pairs(all, split.chosen_by),
                    select_pairs(all, split.tested)};
  const InferenceLesson lesson = lesson_of(recipe, pairs);
  const Image& picture = all.pictures.front();
  refuse_without_memory(estimate_training(recipe, size_of(split, all.numbers.size(), picture.size(),
                                                          picture.channels)),
                        "a smaller batch needs less");
  const Metadata metadata{{"gramloom:settings", to_text(settings, -1, true)}};
  const Image mean = mean_picture(pairs.learnt.pictures);
  const InferenceJudge judge = [&](const InferenceState& state) {
    const std::vector<Image> made = inferred(state.model, pairs.chosen_by);
    write_sheet(run.files.folder / fmt::format("{}_{:06}.png", run.files.name, state.step),
                {pairs.chosen_by.pictures, made}, metadata);
    return relative_error(made, pairs.chosen_by.pictures, mean);
  };
  std::string errors;
  const double seconds = run_training(run, identity, [&](const Control& control) {
    InferenceModel model = train_inference(lesson, control, judge);
    errors = measure(run, pairs, metadata, model);
    write_inference(model_of(run.files), model, {{"identity", identity}});
  });
  run.bar.message(
      fmt::format("{}: trained in {}; {}", run.lesson.name, clock_text(seconds), errors));
}

void make_frames(const LessonRun& run, const FrameSequence& sequence) {
  const InferenceModel model = read_inference(model_of(run.files));
  const std::vector<fs::path> files = frames_of(sequence, run.files);
  create_folder(files.front().parent_path());
  const InferredFiles made = write_inferred(model, poses_of(sequence), files, shown_by(run));
  remove_earlier_frames(files);
  for (const std::string& note : made.notes)
    run.bar.message(fmt::format("{}: {}", run.lesson.name, note));
  run.bar.message(fmt::format("{}: {} frames in {}", run.lesson.name, files.size(),
                              files.front().parent_path().string()));
}

}  // namespace

void check_frames(const ModelEntry& model) {
  const auto& task = std::get<InferenceTask>(model.recipe);
  if (task.pose.empty()) return;
  std::vector<PoseNumber> numbers;
  try {
    const PoseTable table = planned_poses(task);
    if (table.poses.size() < fewest_pairs) return;
    numbers = learnt_numbers(table, split_pairs(table.poses.size(), task.held_out, task.seed));
  } catch (const Error&) {
    return;
  }
  for (const auto& [key, pose] : {std::pair("pose", task.pose), std::pair("to", task.to)}) {
    try {
      check_pose(numbers, pose, task.extrapolate);
    } catch (const ConfigError& error) {
      throw ConfigError("{}: '{}' = [{:g}]: {}", model.place, key, fmt::join(pose, ", "),
                        error.what());
    }
  }
}

void check_frame_files(const ModelEntry& model, const JobFiles& files,
                       const ProtectedFiles& inputs) {
  const auto& task = std::get<InferenceTask>(model.recipe);
  if (task.pose.empty()) return;
  for (const fs::path& file : frames_of(task, files)) check_replaced(file, inputs, inferred_mark);
}

Cost estimate_inference_lesson(const ModelEntry& model) {
  const auto& task = std::get<InferenceTask>(model.recipe);
  const PoseTable table = planned_poses(task);
  check_pairs(table, task.simulation.empty() ? task.pairs : task.simulation);
  const PairSplit split = split_pairs(table.poses.size(), task.held_out, task.seed);
  PairsSize pairs;
  Work work;
  if (task.simulation.empty()) {
    check_pictures(table, task.pairs);
    const Image first = read_image(task.pairs.parent_path() / table.pictures.front()).image;
    pairs = size_of(split, table.names.size(), first.size(), first.channels);
  } else {
    const Simulation simulation = read_simulation(task.simulation);
    pairs = size_of(split, table.names.size(), simulation.sleeve.size, 1);
    work = estimate_simulation(simulation).work;  // its memory is free before the training
  }
  if (!task.pose.empty()) pairs.inferred += static_cast<std::size_t>(task.frames);
  Cost cost = estimate_training(task, pairs);
  cost.work += work;
  return cost;
}

void train_inference_lesson(const LessonRun& run) {
  const auto& task = std::get<InferenceTask>(run.config.models[run.lesson.model].recipe);
  learn(run, task);
  if (!task.pose.empty()) make_frames(run, task);  // again where they are: they are quick
}

}  // namespace gramloom
