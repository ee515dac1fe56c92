#include "python/synthesise.h"

#include <regex>

#include "core/abilities.h"
#include "io/toml_reader.h"
#include "jobs/loaded_request.h"
#include "jobs/memory.h"
#include "jobs/method_reader.h"
#include "jobs/picture_files.h"
#include "jobs/plan.h"
#include "jobs/results.h"
#include "jobs/written_config.h"

namespace gramloom::python {

namespace {

constexpr const char* name = "synthesise";  // of the config, in errors

// Lines of a text that the user has not seen say nothing to him.
std::string without_line(const std::string& message) {
  static const std::regex line("^synthesise:[0-9]+:[0-9]+: ");
  return std::regex_replace(message, line, "synthesise: ");
}

Config read_text(const std::string& text) {
  try {
    const toml::table table = parse_toml(text, name);
    Config config;
    config.file = name;
    read_fields(config, table);
    config.methods.push_back({name, read_method(*table["method"].as_table()), name});
    return config;
  } catch (const ConfigError& error) {
    throw ConfigError("{}", without_line(error.what()));
  }
}

// As the reader of files leaves it (jobs/picture_files.cpp).
PictureFiles files_of(const Material& material, std::size_t number) {
  PictureFiles files;
  files.file = number == 0 ? "the exemplar" : fmt::format("exemplar {}", number + 1);
  const ImageFile& picture = material.picture.file;
  files.files.push_back({"", picture.image.channels, picture.encoding});
  files.images.push_back(picture.image);
  for (const auto& [map, array] : material.maps) {
    const Image& image = array.file.image;
    if (image.size() != picture.image.size())
      throw ConfigError(
          "{}: the map '{}' has {}×{} pixels and its picture {}×{}: they must be equal", name, map,
          image.width, image.height, picture.image.width, picture.image.height);
    ExemplarFile file{map, image.channels, array.file.encoding};
    file.kind = kind_of_map(map, {}, image);
    file.green = green_of_map(map, {}, {});
    files.files.push_back(std::move(file));
    files.images.push_back(image);
  }
  return files;
}

LoadedRequest load(const Config& config, const std::vector<Material>& materials) {
  LoadedRequest loaded;
  loaded.target = {config.size, config.tile};
  if (materials.empty()) return loaded;
  std::vector<PictureFiles> pictures;
  for (const Material& material : materials)
    pictures.push_back(files_of(material, pictures.size()));
  fit_together(pictures, name);
  loaded.files = pictures.front().files;
  for (PictureFiles& picture : pictures) {
    Exemplar exemplar{joined(std::move(picture)), layers_of(loaded.files)};
    check_picture(exemplar.image);
    loaded.exemplars.push_back(std::move(exemplar));
  }
  return loaded;
}

// What `check` says of a job, and a run before it begins one.
void check_possible(const Config& config, const Request& request,
                    const std::vector<ExemplarFile>& files) {
  const RequestSize size = size_of(request);
  Plan plan;
  PlannedJob planned{{}, name, estimate_method(config.methods.front().method, size), {}, {},
                     {}, true};
  if (!files.empty()) {
    planned.job.exemplar = 0;
    plan.exemplars.push_back({true, size, files, ""});
  }
  const std::string refusal = memory_refusal(config, plan, planned, available_memory());
  if (!refusal.empty()) throw ConfigError("{}", refusal);
}

Stored stored_as(Image image, const OutputFormat& format) {
  return stored(scaled(std::move(image), format), format.encoding.pixel_type);
}

}  // namespace

Made synthesise(const std::string& text, const std::vector<Material>& exemplars, Watch& watch) {
  const Config config = read_text(text);
  Request request;
  std::vector<ExemplarFile> files;
  try {
    LoadedRequest loaded = load(config, exemplars);
    files = std::move(loaded.files);
    request = {std::move(loaded.exemplars), std::move(loaded.target),
               Random(static_cast<std::uint64_t>(config.seeds.front()))};
    check_possible(config, request, files);
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("{}: {}", name, error.what());
  }
  Texture texture = split_layers(
      finished_texture(config.methods.front().method, request, watch.control()), files);
  const OutputFormats formats = output_formats(config, files, texture);
  Made made{stored_as(std::move(texture.image), formats.picture), {}};
  for (auto& [map, image] : texture.maps)
    made.maps[map] = stored_as(std::move(image), formats.maps.at(map));
  return made;
}

}  // namespace gramloom::python
