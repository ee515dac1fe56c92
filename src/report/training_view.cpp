#include "report/training_view.h"

#include <algorithm>

#include "core/error.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "report/page_data.h"
#include "runs/samples.h"
#include "runs/trace_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t points = 300;  // of a curve of losses

Json samples_of(const fs::path& run, const std::string& name) {
  Json samples = Json::array();
  for (const Sample& sample : samples_in(run / "models", name)) {
    const Size size = read_image_size(sample.file);
    samples.push_back({{"file", (fs::path("models") / sample.file.filename()).generic_string()},
                       {"step", sample.step ? Json(*sample.step) : Json()},
                       {"width", size.width},
                       {"height", size.height}});
  }
  return samples;
}

Json view_of_model(const fs::path& run, const fs::path& model) {
  const std::string name = model.stem().string();
  const fs::path trace_file = fs::path("models") / (name + ".csv");
  Trace trace;
  if (fs::exists(run / trace_file)) trace = parse_trace(read_text(run / trace_file));
  const bool traced = !trace.rows.empty();
  return {{"name", name},
          {"file", (fs::path("models") / model.filename()).generic_string()},
          {"trace", traced ? thin_trace(trace, points) : Json()},
          {"trace_file", traced ? trace_file.generic_string() : ""},
          {"samples", samples_of(run, name)}};
}

}  // namespace

Json training_views(const RunOnDisk& run, Json& trouble) {
  std::vector<fs::path> models;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(run.folder / "models", ignored))
    if (entry.path().extension() == ".safetensors") models.push_back(entry.path());
  std::ranges::sort(models);
  Json views = Json::array();
  for (const fs::path& model : models) {
    try {
      views.push_back(view_of_model(run.folder, model));
    } catch (const std::exception& error) {
      trouble.push_back(message_of(error));
    }
  }
  return views;
}

}  // namespace gramloom
