#include "learnt/inference_model.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "learnt/model_file.h"

namespace gramloom {

namespace {

// Throws Error for a description that no inference has.
void check_description(const InferenceDescription& description, const std::string& file) {
  const auto fail = [&](const std::string& why) { throw Error("{}: {}", file, why); };
  if (description.pose.empty() || description.pose.size() > 256)
    fail("an inference has a pose of 1 to 256 numbers");
  for (const PoseNumber& number : description.pose)
    if (!(number.low <= number.high))
      fail(fmt::format("the range of '{}' ends before it begins", number.name));
  if (description.hidden.empty() || description.hidden.size() > 10)
    fail("an inference has 1 to 10 sizes");
}

std::string names_of(const std::vector<PoseNumber>& numbers) {
  std::string names;
  for (const PoseNumber& number : numbers)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", number.name);
  return names;
}

}  // namespace

std::vector<Size> inference_sizes(const InferenceDescription& description) {
  std::vector<Size> sizes(description.hidden.size(), description.size);
  for (std::size_t k = sizes.size(); k-- > 1;)
    sizes[k - 1] = {(sizes[k].width + 1) / 2, (sizes[k].height + 1) / 2};
  return sizes;
}

int channels_after(const InferenceDescription& description, std::size_t k) {
  return description.hidden[std::min(k + 1, description.hidden.size() - 1)];
}

std::map<std::string, std::vector<std::int64_t>> tensor_shapes(
    const InferenceDescription& description) {
  std::map<std::string, std::vector<std::int64_t>> shapes;
  const Size smallest = inference_sizes(description).front(), size = description.size;
  const std::int64_t values = description.pose_hidden, channels = description.channels;
  const std::int64_t start =
      std::int64_t{description.hidden.front()} * smallest.width * smallest.height;
  shapes["pose.0.weight"] = {values, static_cast<std::int64_t>(description.pose.size())};
  shapes["pose.1.weight"] = {values, values};
  shapes["pose.0.bias"] = shapes["pose.1.bias"] = {values};
  shapes["start.weight"] = {start, values};
  shapes["start.bias"] = {start};
  for (std::size_t k = 0; k < description.hidden.size(); ++k) {
    const int outputs = channels_after(description, k);
    shapes[fmt::format("layers.{}.weight", k)] = {outputs, description.hidden[k], 3, 3};
    shapes[fmt::format("layers.{}.bias", k)] = {outputs};
  }
  shapes["out.weight"] = {channels, description.hidden.back(), 3, 3};
  shapes["pictures.mean"] = {channels, size.height, size.width};
  for (const char* name : {"out.bias", "pictures.deviation", "pictures.low", "pictures.high"})
    shapes[name] = {channels};
  return shapes;
}

InferenceDescription read_inference_description(const std::filesystem::path& file) {
  auto description = read_description<InferenceDescription>(file, "inference");
  check_description(description, file.string());
  return description;
}

InferenceModel read_inference(const std::filesystem::path& file) {
  InferenceModel model{read_inference_description(file), read_tensors(file)};
  check_tensors(model.tensors, tensor_shapes(model.description), file.string());
  return model;
}

void write_inference(const std::filesystem::path& file, const InferenceModel& model,
                     const std::map<std::string, std::string>& more) {
  auto metadata = described(model.description);
  metadata.insert(more.begin(), more.end());
  write_tensors(file, model.tensors, metadata);
}

void check_pose(const std::vector<PoseNumber>& numbers, const std::vector<double>& pose,
                bool extrapolates) {
  if (pose.size() != numbers.size())
    throw ConfigError("a pose of {} numbers, the model's has {}: {}", pose.size(), numbers.size(),
                      names_of(numbers));
  for (std::size_t i = 0; i < pose.size(); ++i) {
    if (!std::isfinite(pose[i]))
      throw ConfigError("{} = {} is no number", numbers[i].name, pose[i]);
    if (!extrapolates && (pose[i] < numbers[i].low || pose[i] > numbers[i].high))
      throw ConfigError("{} = {}: learnt are {} to {} (extrapolate allows others)", numbers[i].name,
                        pose[i], numbers[i].low, numbers[i].high);
  }
}

}  // namespace gramloom
