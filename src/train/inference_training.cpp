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

InferenceModel train_inference(const InferenceLesson& lesson, const Control& control,
                               const InferenceJudge& judge) {
  check_fields(lesson.recipe);
  if (lesson.recipe.hidden.empty() || lesson.recipe.hidden.size() > 10)
    throw ConfigError("hidden has {} numbers: allowed are 1 to 10", lesson.recipe.hidden.size());
  InferenceLesson whole = lesson;
  InferenceDescription& description = whole.description;
  description.size = lesson.pictures.front().size();
  description.channels = lesson.pictures.front().channels;
  description.wraps = wrapping_axes(lesson.pictures);
  description.pose_hidden = lesson.recipe.pose_hidden;
  description.hidden = lesson.recipe.hidden;
  description.recipe = to_json_value(lesson.recipe);
  return open_module<TrainModule>().train_inference(whole, control, judge);
}

Cost estimate_training(const InferenceLesson& lesson) {
  const Image& picture = lesson.pictures.front();
  const auto& hidden = lesson.recipe.hidden;
  double pixels = 1.0 * picture.width * picture.height, products = 0, values = 0;
  for (std::size_t k = hidden.size(); k-- > 0; pixels /= 4) {
    const int next = hidden[std::min(k + 1, hidden.size() - 1)];
    products += pixels * 9 * hidden[k] * next;
    values += pixels * 6 * next;
  }
  const double data = static_cast<double>(lesson.pictures.size()) * 8 * picture.width *
                      picture.height * picture.channels;
  return {3e8 + data + 4 * values * lesson.recipe.batch,
          {.serial = 1 + 0.005 * lesson.recipe.steps,
           .operations = 20.0 * lesson.recipe.steps * lesson.recipe.batch * products}};
}

}  // namespace gramloom
