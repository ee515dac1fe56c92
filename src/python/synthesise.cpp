#include "python/synthesise.h"

#include <regex>

#include "jobs/loaded_request.h"
#include "jobs/memory.h"
#include "jobs/plan.h"
#include "jobs/results.h"
#include "jobs/written_config.h"

namespace gramloom::python {

namespace {

constexpr const char* name = "synthesise";  // of the config, in errors

// Lines of a text that the user has not seen say nothing to him.
std::string without_line(const std::string& message) {
  static const std::regex line("synthesise:[0-9]+:[0-9]+: ");
  return std::regex_replace(message, line, "synthesise: ", std::regex_constants::format_first_only);
}

// What `check` says of a job, and a run before it begins one.
Job only_job(const Config& config) {
  Plan plan = list_jobs(config);
  if (plan.jobs.size() != 1)
    throw ConfigError("{}: one texture at a time, not {}", name, plan.jobs.size());
  plan_job(config, plan, 0);
  const PlannedJob& planned = plan.jobs.front();
  if (!config.exemplars.empty() && !planned.job.exemplar)
    throw ConfigError("{}: {} needs no exemplar", name, config.methods.front().name);
  const std::string refusal = !planned.error.empty()
                                  ? planned.error
                                  : memory_refusal(config, plan, planned, available_memory());
  if (!refusal.empty()) throw ConfigError("{}: {}", name, refusal);
  return planned.job;
}

// The config and what its job asks for.
struct Prepared {
  Config config;
  LoadedRequest loaded;
};

Prepared prepare(const std::string& text, PicturesInMemory::Pictures pictures) {
  const PicturesInMemory found(std::move(pictures));
  try {
    Prepared prepared{parse_config(text, name), {}};
    prepared.loaded = load_request(prepared.config, only_job(prepared.config).exemplar);
    return prepared;
  } catch (const ConfigError& error) {
    throw ConfigError("{}", without_line(error.what()));
  } catch (const Error& error) {
    throw ConfigError("{}: {}", name, error.what());
  }
}

Stored stored_as(Image image, const OutputFormat& format) {
  return stored(scaled(std::move(image), format), format.encoding.pixel_type);
}

}  // namespace

Made synthesise(const std::string& text, PicturesInMemory::Pictures pictures, Watch& watch) {
  auto [config, loaded] = prepare(text, std::move(pictures));
  const Request request{std::move(loaded.exemplars), std::move(loaded.target),
                        Random(static_cast<std::uint64_t>(config.seeds.front()))};
  Texture texture = split_layers(
      finished_texture(config.methods.front().method, request, watch.control()), loaded.files);
  const OutputFormats formats = output_formats(config, loaded.files, texture);
  Made made{stored_as(std::move(texture.image), formats.picture), {}};
  for (auto& [map, image] : texture.maps)
    made.maps[map] = stored_as(std::move(image), formats.maps.at(map));
  return made;
}

}  // namespace gramloom::python
