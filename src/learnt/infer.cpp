#include <algorithm>

#include "core/portable_math.h"
#include "learnt/inference_model.h"

namespace gramloom {

namespace {

// Pictures of one size, a channel after the other.
struct Planes {
  Size size;
  int channels = 0;
  std::vector<float> values;

  Planes(Size size_, int channels_)
      : size(size_), channels(channels_), values(plane() * static_cast<std::size_t>(channels_)) {}
  std::size_t plane() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  }
  float* row(int channel, int y) {
    return values.data() + static_cast<std::size_t>(channel) * plane() +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width);
  }
  const float* row(int channel, int y) const { return const_cast<Planes*>(this)->row(channel, y); }
};

void activate(std::vector<float>& values) {
  for (float& x : values) {
    const double value = static_cast<double>(x);
    x = static_cast<float>(value / (1 + portable::exp(-value)));
  }
}

std::vector<float> linear(const InferenceModel& model, const std::string& name,
                          const std::vector<float>& input) {
  const std::vector<float>& weights = model.values(name + ".weight");
  std::vector<float> output = model.values(name + ".bias");
  const float* weight = weights.data();
  for (float& sum : output)
    for (const float value : input) sum += *weight++ * value;
  return output;
}

// One pixel more on each side.
Planes padded(const Planes& inner, Tile wraps) {
  const Size size = inner.size;
  Planes outer({size.width + 2, size.height + 2}, inner.channels);
  const auto beyond = [](int place, int length, bool wrap) {
    return wrap ? (place + length) % length : std::clamp(place, 0, length - 1);
  };
  for (int c = 0; c < inner.channels; ++c)
    for (int y = 0; y < outer.size.height; ++y) {
      const float* from = inner.row(c, beyond(y - 1, size.height, tiles_y(wraps)));
      float* to = outer.row(c, y);
      std::copy_n(from, size.width, to + 1);
      to[0] = from[beyond(-1, size.width, tiles_x(wraps))];
      to[size.width + 1] = from[beyond(size.width, size.width, tiles_x(wraps))];
    }
  return outer;
}

Planes convolved(const InferenceModel& model, const std::string& name, const Planes& input) {
  const std::vector<float>& bias = model.values(name + ".bias");
  const float* weight = model.values(name + ".weight").data();
  const Planes around = padded(input, model.description.wraps);
  Planes output(input.size, static_cast<int>(bias.size()));
  for (int o = 0; o < output.channels; ++o) {
    std::fill_n(output.row(o, 0), output.plane(), bias[static_cast<std::size_t>(o)]);
    for (int i = 0; i < input.channels; ++i, weight += 9)
      for (int y = 0; y < input.size.height; ++y) {
        float* to = output.row(o, y);
        for (int dy = 0; dy < 3; ++dy) {
          const float* from = around.row(i, y + dy);
          const float left = weight[3 * dy], middle = weight[3 * dy + 1],
                      right = weight[3 * dy + 2];
          for (int x = 0; x < input.size.width; ++x)
            to[x] += left * from[x] + middle * from[x + 1] + right * from[x + 2];
        }
      }
  }
  return output;
}

// Twice as large, linearly, each pixel's centre in the middle of four; then cut to `size`.
Planes enlarged(const Planes& input, Size size, Tile wraps) {
  const Planes around = padded(input, wraps);
  Planes output(size, input.channels);
  for (int c = 0; c < input.channels; ++c)
    for (int y = 0; y < size.height; ++y) {
      const float* near = around.row(c, y / 2 + 1);
      const float* far = around.row(c, y / 2 + (y % 2 == 0 ? 0 : 2));
      float* to = output.row(c, y);
      const auto value = [&](int x) { return 0.75f * near[x] + 0.25f * far[x]; };
      for (int x = 0; x < size.width; ++x)
        to[x] = 0.75f * value(x / 2 + 1) + 0.25f * value(x / 2 + (x % 2 == 0 ? 0 : 2));
    }
  return output;
}

std::vector<float> normalised(const InferenceDescription& description,
                              const std::vector<double>& pose) {
  std::vector<float> values;
  for (std::size_t i = 0; i < description.pose.size(); ++i) {
    const PoseNumber& number = description.pose[i];
    const double range = number.high - number.low;
    values.push_back(range > 0 ? static_cast<float>(2 * (pose[i] - number.low) / range - 1) : 0.0f);
  }
  return values;
}

}  // namespace

Image infer(const InferenceModel& model, const std::vector<double>& pose) {
  const InferenceDescription& description = model.description;
  std::vector<float> values = normalised(description, pose);
  for (const char* name : {"pose.0", "pose.1"}) {
    values = linear(model, name, values);
    activate(values);
  }
  const std::vector<Size> sizes = inference_sizes(description);
  Planes planes(sizes.front(), description.hidden.front());
  planes.values = linear(model, "start", values);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    planes = convolved(model, fmt::format("layers.{}", k), planes);
    activate(planes.values);
    if (k + 1 < sizes.size()) planes = enlarged(planes, sizes[k + 1], description.wraps);
  }
  planes = convolved(model, "out", planes);

  Image picture(description.size, description.channels);
  for (int c = 0; c < picture.channels; ++c) {
    const auto channel = static_cast<std::size_t>(c);
    const float* mean = model.values("pictures.mean").data() + channel * planes.plane();
    const float* from = planes.row(c, 0);
    const float deviation = model.values("pictures.deviation")[channel];
    const float low = model.values("pictures.low")[channel];
    const float high = model.values("pictures.high")[channel];
    for (std::size_t i = 0; i < planes.plane(); ++i)
      picture.pixels[i * static_cast<std::size_t>(picture.channels) + channel] =
          std::clamp(mean[i] + deviation * from[i], low, high);
  }
  return picture;
}

Cost estimate_inference(const InferenceDescription& description) {
  constexpr double seconds_per_product = 2.5e-10, seconds_per_value = 2e-8;  // measured
  const std::vector<Size> sizes = inference_sizes(description);
  double products = 0, values = 0, most = 0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double pixels = 1.0 * sizes[k].width * sizes[k].height;
    const int channels = description.hidden[k], next = channels_after(description, k);
    products += pixels * 9 * channels * next;
    values += pixels * next;
    most = std::max(most, pixels * (2 * channels + next));  // with what lies around its border
  }
  const double start = 1.0 * sizes.front().width * sizes.front().height *
                       description.hidden.front() * description.pose_hidden;
  return {4 * most,
          {.serial = (products + start) * seconds_per_product + values * seconds_per_value}};
}

}  // namespace gramloom
