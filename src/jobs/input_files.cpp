#include "jobs/input_files.h"

#include "jobs/inputs.h"
#include "jobs/job_preview.h"
#include "neural/network/network_description.h"
#include "runs/job_files.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// What the method looks up by a name: its network or its model. One that there is not is found
// elsewhere.
template <class Params>
fs::path looked_up(const Params& params) {
  try {
    if constexpr (HasNetwork<Params>) return network_file(params);
    if constexpr (HasModel<Params>) return model_file(params);
  } catch (const Error&) {
  }
  return {};
}

void add_files_of(const Method& method, std::vector<InputFile>& files) {
  std::visit(
      [&](const auto& params) {
        const auto add = [&](const fs::path& file) {
          if (!file.empty()) files.push_back({file, "the config reads"});
        };
        for_each_parameter(params, [&]<class T>(const auto&, const T& value) {
          if constexpr (std::is_same_v<fs::path, T>) add(value);
        });
        add(looked_up(params));
      },
      method);
}

}  // namespace

std::vector<InputFile> input_files(const Config& config) {
  std::vector<InputFile> files{{config.file, "is the config"}};
  for (const ExemplarEntry& exemplar : config.exemplars)
    for (const ExemplarPicture& picture : pictures_of(exemplar))
      for (const auto& [key, file] : files_of(picture)) files.push_back({file, "the config reads"});
  for (const auto& [key, file] : files_of(config.direction))
    files.push_back({file, "the config reads"});
  for (const MethodEntry& method : config.methods) add_files_of(method.method, files);
  for (const PreviewEntry& preview : config.previews)
    for (const auto& [key, file] : preview_files(preview))
      files.push_back({file, "the config reads"});
  return files;
}

std::vector<InputFile> input_files(const Baseline& baseline) {
  const std::string reader = "--baseline reads";
  std::vector<InputFile> files{{baseline.folder / "run.json", reader}};
  for (const auto& [name, record] : baseline.jobs) {
    const JobFiles job = job_files(baseline.folder, name);
    files.push_back({job.record, reader});
    for (const auto& picture : record.files) files.push_back({job.folder / picture, reader});
  }
  return files;
}

}  // namespace gramloom
