#include "jobs/infer_pictures.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "io/models_folder.h"
#include "jobs/frame_sequence.h"
#include "jobs/pose_table.h"
#include "jobs/protected_files.h"
#include "runs/csv_fields.h"
#include "runs/frames.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

std::vector<double> pose_of(std::string_view option, const std::string& text) {
  std::vector<double> pose;
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    try {
      pose.push_back(from_cell<double>(word));
    } catch (const Error& error) {
      throw ConfigError("{} {}: {}", option, text, error.what());
    }
  }
  return pose;
}

void check_given(const InferenceDescription& description, const std::vector<double>& pose,
                 const std::string& place, bool extrapolates) {
  try {
    check_pose(description.pose, pose, extrapolates);
  } catch (const ConfigError& error) {
    throw ConfigError("{}: {}", place, error.what());
  }
}

// The rows of a table, by the model's names.
std::vector<std::vector<double>> poses_of_table(const InferWork& work,
                                                const InferenceDescription& description) {
  std::vector<std::string> names;
  for (const PoseNumber& number : description.pose) names.push_back(number.name);
  const PoseTable table = read_pose_table(work.poses, names);
  std::vector<std::size_t> columns;
  for (const std::string& name : names)
    columns.push_back(static_cast<std::size_t>(
        std::find(table.names.begin(), table.names.end(), name) - table.names.begin()));
  if (table.poses.empty()) throw ConfigError("{}: has no poses", work.poses.string());
  std::vector<std::vector<double>> poses;
  for (std::size_t i = 0; i < table.poses.size(); ++i) {
    std::vector<double>& pose = poses.emplace_back();
    for (const std::size_t column : columns) pose.push_back(table.poses[i][column]);
    check_given(description, pose, fmt::format("{}:{}", work.poses.string(), table.lines[i]),
                work.extrapolates);
  }
  return poses;
}

std::vector<std::vector<double>> poses_of(const InferWork& work,
                                          const InferenceDescription& description) {
  if (!work.poses.empty()) return poses_of_table(work, description);
  const std::vector<double> pose = pose_of("--pose", work.pose);
  check_given(description, pose, "--pose " + work.pose, work.extrapolates);
  if (work.to.empty()) return {pose};
  const std::vector<double> to = pose_of("--to", work.to);
  check_given(description, to, "--to " + work.to, work.extrapolates);
  return poses_of(FrameSequence{pose, to, work.frames});
}

std::vector<fs::path> files_of(const InferWork& work, std::size_t count) {
  const bool one = work.poses.empty() && work.to.empty();
  if (one && !work.format.empty())
    throw ConfigError(
        "--format is for several pictures, of --to or --poses: one takes its type from '{}'",
        work.output.filename().string());
  if (one) return {work.output};
  return frame_files(work.output, count, work.format.empty() ? "exr" : work.format);
}

// How values become those of a file: integers reach from the model's least value to its largest.
struct Scale {
  float low = 0, high = 1;
};
Scale scale_of(const InferenceModel& model, PixelType stored) {
  const auto is_integer = [](PixelType type) {
    return type == PixelType::uint8 || type == PixelType::uint16;
  };
  if (!is_integer(stored) || is_integer(model.description.pixel_type)) return {};
  const auto& low = model.values("pictures.low");
  const auto& high = model.values("pictures.high");
  return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
}

}  // namespace

InferredFiles write_inferred(const InferenceModel& model,
                             const std::vector<std::vector<double>>& poses,
                             const std::vector<fs::path>& files, const Control& control) {
  const InferenceDescription& description = model.description;
  const Scale scale =
      scale_of(model, stored_type(files.front().extension().string(), description.pixel_type));
  InferredFiles inferred;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    control.step(static_cast<std::int64_t>(i), static_cast<std::int64_t>(poses.size()));
    Image picture = infer(model, poses[i]);
    if (scale.high > scale.low)
      for (float& value : picture.pixels) value = (value - scale.low) / (scale.high - scale.low);
    Json pose = Json::object();
    for (std::size_t k = 0; k < poses[i].size(); ++k)
      pose[valid_utf8(description.pose[k].name)] = poses[i][k];
    const auto notes = write_image(files[i], picture, {description.pixel_type, "", {}},
                                   {{inferred_mark, to_text(pose, -1, true)}});
    inferred.files.push_back(files[i]);
    for (const std::string& note : notes)
      inferred.notes.push_back(fmt::format("{}: {}", files[i].filename().string(), note));
  }
  if (scale.low != 0 || scale.high != 1)
    inferred.notes.push_back(fmt::format("{}: 0 stands for {:g} and 1 for {:g}",
                                         files.front().filename().string(), scale.low, scale.high));
  return inferred;
}

InferredFiles infer_pictures(const InferWork& work, const Control& control) {
  InferenceModel model;
  std::vector<std::vector<double>> poses;
  std::vector<fs::path> files;
  try {
    const fs::path file = find_model(work.model, ".safetensors", "model");
    model = read_inference(file);
    poses = poses_of(work, model.description);
    files = files_of(work, poses.size());
    stored_type(files.front().extension().string(), model.description.pixel_type);
    std::vector<InputFile> read{{file, "is the model"}};
    if (!work.poses.empty()) read.push_back({work.poses, "has the poses"});
    const ProtectedFiles inputs(read);
    for (const fs::path& picture : files) check_replaced(picture, inputs, inferred_mark);
    if (files.front() != work.output)
      create_folder(work.output);
    else
      check_folder_of(work.output);
  } catch (const ConfigError& error) {
    throw ConfigError("infer: {}", error.what());
  } catch (const Error& error) {
    throw ConfigError("infer: {}", error.what());
  }
  InferredFiles inferred = write_inferred(model, poses, files, control);
  if (files.front() != work.output) remove_earlier_frames(files);
  return inferred;
}

}  // namespace gramloom
