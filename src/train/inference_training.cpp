#include "train/inference_training.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/modules.h"
#include "train/train_module.h"

namespace gramloom {

namespace {

// Of lines of pixels across an axis: how far each is from the next, the last from the first, as a
// sum of squares. `place(line, i)` is pixel i of a line.
template <class Place>
std::vector<double> steps_along(const Image& picture, int lines, int length, Place place) {
  std::vector<double> steps(static_cast<std::size_t>(lines), 0.0);
  for (int line = 0; line < lines; ++line)
    for (int i = 0; i < length; ++i) {
      const float* own = place(line, i);
      const float* next = place((line + 1) % lines, i);
      for (int c = 0; c < picture.channels; ++c) {
        const double difference = static_cast<double>(own[c]) - static_cast<double>(next[c]);
        steps[static_cast<std::size_t>(line)] += difference * difference;
      }
    }
  return steps;
}

void add(std::vector<double>& sums, const std::vector<double>& values) {
  sums.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i];
}

// Where pictures wrap, the step from the last line to the first is one between its neighbours.
bool wraps(const std::vector<double>& steps) {
  const std::size_t count = steps.size();
  return count < 3 || steps[count - 1] <= 2 * std::max(steps[count - 2], steps[0]);
}

}  // namespace

Tile wrapping_axes(const std::vector<Image>& pictures) {
  std::vector<double> along_x, along_y;
  for (const Image& picture : pictures) {
    const int width = picture.width, height = picture.height;
    add(along_x,
        steps_along(picture, width, height, [&](int x, int y) { return picture.at(x, y); }));
    add(along_y,
        steps_along(picture, height, width, [&](int y, int x) { return picture.at(x, y); }));
  }
  return wrapping(wraps(along_x), wraps(along_y));
}

void check_recipe(const InferenceRecipe& recipe) {
  check_fields(recipe);
  if (recipe.hidden.empty() || recipe.hidden.size() > 10)
    throw ConfigError("hidden has {} numbers: allowed are 1 to 10", recipe.hidden.size());
}

namespace {

// Of the network, all that its size hangs on but the numbers of a pose.
void describe(const InferenceRecipe& recipe, Size size, int channels,
              InferenceDescription& description) {
  description.size = size;
  description.channels = channels;
  description.pose_hidden = recipe.pose_hidden;
  description.hidden = recipe.hidden;
}

double count_of_tensors(const InferenceDescription& description) {
  double count = 0;
  for (const auto& [name, shape] : tensor_shapes(description)) {
    double values = 1;
    for (const std::int64_t length : shape) values *= static_cast<double>(length);
    count += values;
  }
  return count;
}

// Measured; seconds of one thread.
constexpr double bytes_of_libraries = 2.65e8;
constexpr double bytes_per_value = 20;      // of all pictures: as they are, learnt, and centred
constexpr double bytes_per_map_value = 19;  // of a batch: what the gradient needs of each layer
constexpr double bytes_per_weight = 30;     // with its slope, Adam's means and the best one so far
constexpr double bytes_per_weight_written = 32;  // in a checkpoint, when maps are gone
constexpr double seconds_per_step = 0.004;
constexpr double seconds_per_map_value = 1.2e-8;
constexpr double seconds_per_weight = 6e-9;
constexpr double operations_per_product =
    3.6;  // and both slopes; oneDNN needs fewer for 3×3 filters
constexpr double seconds_per_blended_value = 1e-6;  // of 85 blends, for each that they choose by

}  // namespace

InferenceModel train_inference(const InferenceLesson& lesson, const Control& control,
                               const InferenceJudge& judge) {
  check_recipe(lesson.recipe);
  InferenceLesson whole = lesson;
  InferenceDescription& description = whole.description;
  const Image& first = lesson.pictures.front();
  describe(lesson.recipe, first.size(), first.channels, description);
  description.wraps = wrapping_axes(lesson.pictures);
  description.recipe = to_json_value(lesson.recipe);
  return open_module<TrainModule>().train_inference(whole, control, judge);
}

Cost estimate_training(const InferenceRecipe& recipe, const PairsSize& pairs) {
  check_recipe(recipe);
  InferenceDescription description;
  describe(recipe, pairs.size, pairs.channels, description);
  description.pose.resize(static_cast<std::size_t>(pairs.numbers));
  const std::vector<Size> sizes = inference_sizes(description);
  double products = 0, maps = 0;  // of one picture
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const int next = channels_after(description, k);
    const double pixels = 1.0 * sizes[k].width * sizes[k].height;
    products += pixels * 9 * recipe.hidden[k] * next;
    maps += pixels * (recipe.hidden[k] + next);
  }
  const double picture = 1.0 * pairs.size.width * pairs.size.height * pairs.channels;
  const double count = static_cast<double>(pairs.learnt + pairs.chosen_by);
  const double weights = count_of_tensors(description);
  const double looks = std::ceil(1.0 * recipe.steps / recipe.sample_every);
  const double inferred =
      looks * static_cast<double>(pairs.chosen_by) + static_cast<double>(pairs.inferred);
  const Work step{
      .serial = seconds_per_step,
      .shared = maps * recipe.batch * seconds_per_map_value + weights * seconds_per_weight,
      .operations = operations_per_product * recipe.batch * products};
  const double blends = static_cast<double>(pairs.chosen_by) * picture * seconds_per_blended_value;
  return {bytes_of_libraries + count * picture * bytes_per_value +
              std::max(maps * recipe.batch * bytes_per_map_value + weights * bytes_per_weight,
                       weights * bytes_per_weight_written),
          Work{.serial = 1 + blends} + recipe.steps * step +
              inferred * estimate_inference(description).work};
}

}  // namespace gramloom
