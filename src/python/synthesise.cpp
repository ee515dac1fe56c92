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

// Lines of a text that the user has not seen say nothing to him, and two of its words are not those
// of the arguments.
std::string of_arguments(std::string message) {
  static const std::pair<std::regex, const char*> changes[] = {
      {std::regex("synthesise:[0-9]+:[0-9]+: "), "synthesise: "},
      {std::regex("'seeds'"), "'seed'"},
      {std::regex("\\[\\[exemplar\\]\\]"), "exemplar"}};
  for (const auto& [words, argument] : changes)
    message = std::regex_replace(message, words, argument);
  return message;
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
    throw ConfigError("{}", of_arguments(error.what()));
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
