#include "train/inference_training.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/modules.h"
#include "train/train_module.h"

namespace gramloom {

namespace {

// The mean square of how far pixel (x, y) and the one at `dx`, `dy` from it are apart.
class Differences {
 public:
  void add(const float* a, const float* b, int channels) {
    for (int c = 0; c < channels; ++c) {
      const double difference = static_cast<double>(a[c]) - static_cast<double>(b[c]);
      sum_ += difference * difference;
    }
    ++count_;
  }
  double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }

 private:
  double sum_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace

Tile wrapping_axes(const std::vector<Image>& pictures) {
  Differences along_x, along_y, around_x, around_y;
  for (const Image& picture : pictures) {
    const int width = picture.width, height = picture.height;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const auto add = [&](Differences& differences, int to_x, int to_y) {
          differences.add(picture.at(x, y), picture.at(to_x, to_y), picture.channels);
        };
        add(x + 1 < width ? along_x : around_x, (x + 1) % width, y);
        add(y + 1 < height ? along_y : around_y, x, (y + 1) % height);
      }
  }
  return wrapping(around_x.mean() <= along_x.mean(), around_y.mean() <= along_y.mean());
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
          1 + lesson.recipe.steps * (0.005 + lesson.recipe.batch * products * 1e-10)};
}

}  // namespace gramloom
