#include "report/live_view.h"

#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/hash.h"
#include "io/field_values.h"
#include "io/models_folder.h"
#include "io/text_file.h"
#include "learnt/export_glsl.h"
#include "learnt/generator.h"
#include "runs/job_files.h"
#include "runs/job_maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// The model's file, if it is still what the job read.
std::optional<fs::path> find_unchanged(const JobRecord& record, const std::string& model,
                                       const std::string& hash) {
  FileOrName file = model;
  if (!file.is_name()) file = fs::path(record.config).parent_path() / model;
  try {
    const fs::path found = find_model(file, ".safetensors", "model");
    if (fs::is_regular_file(found) && hash_of(read_text(found)) == hash) return found;
  } catch (const Error&) {
  }
  return std::nullopt;
}

// None where they are too long.
std::optional<std::string> shaders_of(const fs::path& file, const std::vector<double>& weights) {
  const GeneratorModel model = read_generator(file);
  GeneratorParams params;
  params.weights = weights;
  const auto wanted = generation_of(params, model.description, {1, 1}, Tile::none, Random(1));
  const PlainGenerator generator = plain_generator(model, wanted.shares);
  if (generator.weight_count() > live_view_limit / 8) return std::nullopt;  // no need to look
  std::string shaders = export_glsl(generator, "gramloom");
  return shaders.size() > live_view_limit ? std::nullopt : std::optional(std::move(shaders));
}

}  // namespace

Json live_view(const RunOnDisk& run, const JobOnDisk& job) {
  const JobRecord& record = job.record;
  if (record.kind != GeneratorParams::kind || !record.settings.is_object()) return nullptr;
  const Json method = record.settings.value("method", Json::object());
  const std::string hash = record.settings.value("/files/model"_json_pointer, "");
  if (!method.is_object() || hash.empty() || !method.value("weight_picture", "").empty())
    return nullptr;
  const auto weights = method.value("weights", std::vector<double>());
  const std::string name =
      hash_of(fmt::format("{} {} {}", export_glsl_format, hash, fmt::join(weights, ","))) +
      ".live.js";
  const fs::path shown = fs::path("page") / name;
  const Json view{{"file", shown.generic_string()}, {"tile", to_word(tile_of(record.settings))}};
  std::error_code ignored;
  if (fs::is_regular_file(run.folder / shown, ignored)) return view;
  const auto model = find_unchanged(record, method.value("model", ""), hash);
  if (!model) return nullptr;
  const auto shaders = shaders_of(*model, weights);
  if (!shaders) return nullptr;
  fs::create_directories((run.folder / shown).parent_path(), ignored);
  write_text(run.folder / shown,
             fmt::format("liveData({}, {});\n", to_text(Json(shown.generic_string()), -1, true),
                         to_text(Json(*shaders), -1, true)));
  return view;
}

}  // namespace gramloom
