#include "jobs/plan.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/abilities.h"
#include "core/threads.h"
#include "jobs/job_preview.h"
#include "jobs/loaded_request.h"
#include "jobs/pattern.h"
#include "jobs/results.h"
#include "jobs/settings.h"
#include "metrics/scores.h"

namespace gramloom {

namespace {

const ExemplarFacts& facts_of(const Plan& plan, const Job& job) {
  static const ExemplarFacts none;
  return job.exemplar ? plan.exemplars[*job.exemplar] : none;
}

// Throws Error for what no method takes.
void check_values(const ExemplarEntry& entry, const LoadedRequest& loaded) {
  try {
    for (const Exemplar& exemplar : loaded.exemplars) check_picture(exemplar.image);
  } catch (const Error& error) {
    throw Error("{}: {}", entry.image.string(), error.what());
  }
}

// Throws ConfigError when maps are to be made of a height that is none.
void check_height(const Config& config, const ExemplarEntry& exemplar,
                  const LoadedRequest& loaded) {
  if (maps_asked(config.surface).empty()) return;
  const std::string height = height_among(exemplar.maps, config.surface);
  const Exemplar& first = loaded.exemplars.front();
  for (const Layer& layer : first.layers) {
    if (layer.name.empty() || layer.name != height) continue;
    try {
      one_channel(extract_channels(first.image, layer.first, layer.count));
    } catch (const Error& error) {
      throw ConfigError("{}: {}: {}", exemplar.place, exemplar.maps.at(height).image.string(),
                        error.what());
    }
  }
}

ExemplarFacts look_at(const Config& config, std::size_t number) {
  ExemplarFacts facts{true, {}, {}, ""};
  const ExemplarEntry& exemplar = config.exemplars[number];
  try {
    LoadedRequest loaded = load_request(config, number);
    facts.files = std::move(loaded.files);
    check_values(exemplar, loaded);
    check_height(config, exemplar, loaded);
    facts.request = size_of({std::move(loaded.exemplars), std::move(loaded.target)});
  } catch (const ConfigError&) {
    throw;  // for the user to mend first
  } catch (const Error& error) {
    facts.error = error.what();
  }
  return facts;
}

// Throws Error when the config's format cannot hold a texture or one of its maps.
void check_formats(const Config& config, const ExemplarFacts& facts) {
  constexpr int colours = 3;  // that procedural textures have
  if (facts.files.empty()) output_format(config, {}, colours);
  for (const ExemplarFile& file : facts.files) output_format(config, file.encoding, file.channels);
}

// What a job asks for at this size of the texture.
RequestSize request_size(const Config& config, const Plan& plan, const Job& job, Size size) {
  RequestSize request = facts_of(plan, job).request;
  request.size = size;
  request.tile = config.tile;
  if (job.exemplar) return request;
  // A method of formulas is asked as much, and says what it cannot.
  const Direction& direction = config.direction;
  request.known = direction.fill.has_value();
  request.guide = direction.guide.has_value();
  request.weights = direction.mix.has_value();
  request.turn = direction.turn.has_value();
  return request;
}

// The first one's memory stays.
Cost one_after_the_other(const Cost& first, const Cost& second) {
  return {first.bytes + second.bytes, first.work + second.work};
}

// Of reading a job's exemplars and writing its texture; all with their maps. Measured with PNG.
Cost cost_of_files(const Config& config, const ExemplarFacts& facts) {
  double in = 0;
  for (const ExemplarSize& exemplar : facts.request.exemplars)
    in += 1.0 * exemplar.size.width * exemplar.size.height * exemplar.channels;
  constexpr int of_formulas = 3;
  const int channels =
      facts.request.exemplars.empty() ? of_formulas : facts.request.exemplars.front().channels;
  const double pixels = 1.0 * config.size.width * config.size.height;
  constexpr double source = 8;  // of each pixel, where a method copies
  return {std::max(18 * in, (4 * channels + source) * pixels),
          {.serial = 1.8e-7 * in + (8e-8 * channels + 3e-8) * pixels}};
}

// Of what a job makes of its texture: the file, the maps of its height, its preview.
Cost cost_of_finishing(const Config& config, const ExemplarFacts& facts, const Job& job) {
  Cost cost = cost_of_files(config, facts);
  if (makes_maps(config, job))
    cost = one_after_the_other(cost, estimate_maps(config.surface, config.size, config.tile));
  for (const PreviewEntry* preview : previews_of(config, job))
    cost = one_after_the_other(cost, estimate_entry(*preview, config.size));
  return cost;
}

// Of a filled picture only the joins are scored.
Cost cost_of_scoring(const Config& config, const ExemplarFacts& facts) {
  Cost cost;
  if (config.direction.fill) {
    const double values =
        1.0 * config.size.width * config.size.height * (facts.files.front().channels + 1);
    return {1e7 + 8 * values, {.serial = 0.1 + 1e-7 * values}};
  }
  for (const ExemplarSize& exemplar : facts.request.exemplars) {
    const Cost one = estimate_scores(exemplar.size, facts.files.front().channels, config.size);
    cost = {std::max(cost.bytes, one.bytes), cost.work + one.work};
  }
  return cost;
}

// The cost of a job, or why the method cannot do it. A ConfigError is for the user to mend first.
void estimate_job(const Config& config, const Plan& plan, PlannedJob& planned) {
  const MethodEntry& method = config.methods[planned.job.method];
  const ExemplarFacts& facts = facts_of(plan, planned.job);
  planned.error = facts.error;
  if (!planned.error.empty()) return;
  try {
    check_formats(config, facts);
    planned.cost =
        estimate_method(method.method, request_size(config, plan, planned.job, config.size));
    planned.finishing = cost_of_finishing(config, facts, planned.job);
    if (config.scores && planned.job.exemplar) planned.scoring = cost_of_scoring(config, facts);
  } catch (const ConfigError& error) {
    throw ConfigError("{}: method '{}': {}", method.place, method.name, error.what());
  } catch (const Error& error) {
    planned.error = error.what();
  }
}

// Those of all groups of two or more selected seeds that can be made.
std::vector<PlannedDiversity> plan_diversities(const Config& config, const Plan& plan) {
  std::map<std::string, int> seeds;
  std::vector<PlannedDiversity> diversities;
  if (!config.scores || config.direction.fill) return diversities;
  for (const PlannedJob& planned : plan.jobs) {
    if (!planned.selected || !planned.job.exemplar || !planned.error.empty()) continue;
    const std::string name = job_folder(config, planned.job);
    const int count = ++seeds[name];
    if (count < 2) continue;
    if (count > 2) diversities.pop_back();
    const int channels = facts_of(plan, planned.job).files.front().channels;
    diversities.push_back({name, estimate_diversity(config.size, channels, count)});
  }
  return diversities;
}

// Whether the method has jobs of this exemplar; of none: without one.
bool takes(const Config& config, const Method& method, std::optional<std::size_t> exemplar) {
  const std::string compared = compared_with(method);
  if (compared.empty()) return needs_exemplar(method) == exemplar.has_value();
  return exemplar && config.exemplars[*exemplar].name == compared;
}

std::vector<Job> all_jobs(const Config& config) {
  std::vector<Job> jobs;
  const auto add = [&](std::optional<std::size_t> exemplar) {
    for (std::size_t method = 0; method < config.methods.size(); ++method)
      if (takes(config, config.methods[method].method, exemplar))
        for (const int seed : config.seeds) jobs.push_back({exemplar, method, seed});
  };
  add(std::nullopt);
  for (std::size_t exemplar = 0; exemplar < config.exemplars.size(); ++exemplar) add(exemplar);
  return jobs;
}

// By a picture, not by the config.
bool size_is_given(const Direction& direction) {
  return direction.fill || direction.guide || direction.turn ||
         (direction.mix && !direction.mix->images.empty());
}

std::string refusal_of(std::string_view work, const Cost& cost, double available) {
  if (cost.bytes <= available) return "";
  return fmt::format("{} needs about {:.1f} GB of memory, {:.1f} GB are free", work,
                     cost.bytes / 1e9, available / 1e9);
}

}  // namespace

std::string exemplar_name(const Config& config, const Job& job) {
  return job.exemplar ? config.exemplars[*job.exemplar].name : std::string(procedural_folder);
}

std::string job_folder(const Config& config, const Job& job) {
  return fmt::format("{}/{}", exemplar_name(config, job), config.methods[job.method].name);
}

std::string job_name(const Config& config, const Job& job) {
  return fmt::format("{}/seed{}", job_folder(config, job), job.seed);
}

bool job_matches(const std::string& pattern, const std::string& job) {
  return pattern.empty() || matches(pattern, job.substr(0, job.rfind('/'))) ||
         matches(pattern, job);
}

bool has_selected(const Plan& plan) {
  return std::ranges::any_of(plan.jobs, &PlannedJob::selected);
}

Plan make_plan(const Config& config, const std::string& only) {
  Plan plan = list_jobs(config, only);
  // Decoding is most of the work, and waiting for the disk.
  const auto exemplars = static_cast<std::int64_t>(config.exemplars.size());
  parallel_for(exemplars, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      plan.exemplars[static_cast<std::size_t>(i)] = look_at(config, static_cast<std::size_t>(i));
  });
  for (std::size_t i = 0; i < plan.jobs.size(); ++i) {
    PlannedJob& planned = plan.jobs[i];
    const PlannedJob* before = i > 0 ? &plan.jobs[i - 1] : nullptr;
    // Seeds cost the same.
    if (before && before->job.method == planned.job.method &&
        before->job.exemplar == planned.job.exemplar) {
      planned.cost = before->cost;
      planned.finishing = before->finishing;
      planned.scoring = before->scoring;
      planned.error = before->error;
    } else {
      plan_job(config, plan, i);
    }
  }
  plan.diversities = plan_diversities(config, plan);
  return plan;
}

Plan list_jobs(const Config& config, const std::string& only) {
  Plan plan;
  plan.exemplars.resize(config.exemplars.size());
  for (const Job& job : all_jobs(config)) {
    PlannedJob planned{job, job_name(config, job), {}, {}, {}, {}, true};
    planned.selected = job_matches(only, planned.name);
    plan.jobs.push_back(std::move(planned));
  }
  if (plan.jobs.empty()) return plan;  // there are only models to train
  if (config.models.empty() && !has_selected(plan))
    throw ConfigError(
        "--only {}: no job of {} matches (* stands for any letters, ? for one, all else for "
        "itself); they are called like {}",
        only, config.file.string(), plan.jobs.front().name);
  return plan;
}

void plan_job(const Config& config, Plan& plan, std::size_t number) {
  PlannedJob& planned = plan.jobs.at(number);
  if (const auto exemplar = planned.job.exemplar; exemplar && !plan.exemplars[*exemplar].known)
    plan.exemplars[*exemplar] = look_at(config, *exemplar);
  estimate_job(config, plan, planned);
}

std::string scoring_refusal(const PlannedJob& job, double available) {
  return refusal_of("scoring", job.scoring, available);
}

std::string diversity_refusal(const Cost& cost, double available) {
  return refusal_of("diversity", cost, available);
}

std::string memory_refusal(const Config& config, const Plan& plan, const PlannedJob& planned,
                           double available) {
  if (planned.cost.bytes <= available)
    return refusal_of("writing it, its maps and preview", planned.finishing, available);
  const auto scaled = [&](double scale) {
    return Size{std::max(1, static_cast<int>(config.size.width * scale)),
                std::max(1, static_cast<int>(config.size.height * scale))};
  };
  const auto fits = [&](Size size) {
    try {
      return estimate_method(config.methods[planned.job.method].method,
                             request_size(config, plan, planned.job, size))
                 .bytes <= available;
    } catch (const Error&) {
      return false;
    }
  };
  double low = 0;
  double high = 1;
  for (int step = 0; step < 20; ++step) {
    const double middle = (low + high) / 2;
    (fits(scaled(middle)) ? low : high) = middle;
  }
  const std::string needs = fmt::format("needs about {:.1f} GB of memory, {:.1f} GB are free",
                                        planned.cost.bytes / 1e9, available / 1e9);
  if (size_is_given(config.direction)) return needs;
  const Size largest = scaled(low);
  if (low > 0 && largest.width >= 16 && largest.height >= 16)
    return fmt::format("{}; size = [{}, {}] would fit", needs, largest.width, largest.height);
  return needs + "; no size would fit: make the exemplar smaller (max_side) or the method cheaper";
}

}  // namespace gramloom
