#include "jobs/listing.h"

#include <algorithm>

#include "core/variants.h"
#include "io/field_values.h"
#include "io/models_folder.h"
#include "jobs/memory.h"
#include "jobs/progress_bar.h"
#include "jobs/simulation.h"
#include "jobs/text_table.h"
#include "learnt/generator_model.h"
#include "learnt/model_file.h"
#include "metrics/map_scores.h"
#include "neural/network/network_description.h"
#include "surface/maps.h"
#include "surface/photo.h"
#include "surface/preview_params.h"

namespace gramloom {

namespace {

// A row for each parameter of Params' own.
template <class Params>
std::vector<Row> parameter_rows() {
  const Params defaults;
  std::vector<Row> rows;
  for_each_field<Params>([&](const auto& field) {
    using T = typename std::decay_t<decltype(field)>::value_type;
    const std::string unit = field.unit.empty() ? "" : fmt::format(" ({})", field.unit);
    rows.push_back({std::string(field.name), "= " + value_to_text(defaults.*field.member),
                    allowed_values<T>(field.range), fmt::format("{}{}", field.meaning, unit)});
  });
  return rows;
}

// "takes: exemplar, mask", or what a method of formulas takes.
std::string ability_line(Abilities abilities) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < enum_names<Ability>.size(); ++i)
    if (abilities.has(static_cast<Ability>(i))) words.push_back(enum_names<Ability>[i]);
  return words.empty() ? "takes no exemplar" : fmt::format("can: {}", fmt::join(words, ", "));
}

template <class Textures>
std::string list_textures() {
  std::string text;
  for_each_alternative<Textures>([&]<class T>(std::type_identity<T>) {
    text += fmt::format("{}: {}\n", T::name, T::summary);
    text += text_table(parameter_rows<T>(), "  ") + "\n";
  });
  return text;
}

// Why a job cannot be done, or cannot be scored; "" when all is well.
std::string problem_of(const Config& config, const Plan& plan, const PlannedJob& planned,
                       double available) {
  const std::string problem =
      !planned.error.empty() ? planned.error : memory_refusal(config, plan, planned, available);
  if (!problem.empty()) return "cannot run: " + problem;
  const std::string unscored = scoring_refusal(planned, available);
  return unscored.empty() ? "" : "cannot be scored: " + unscored;
}

std::string problem_of(const PlannedDiversity& planned, double available) {
  const std::string refusal = diversity_refusal(planned.cost, available);
  return refusal.empty() ? "" : "cannot be compared: " + refusal;
}

std::string memory_text(double bytes) { return fmt::format("{:.2f} GB", bytes / 1e9); }

}  // namespace

std::string list_methods() {
  std::string text;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    text += fmt::format("{}: {}\n", Params::kind, Params::summary);
    text += fmt::format("  {}\n", ability_line(Params::abilities));
    std::vector<Row> rows = parameter_rows<Params>();
    if constexpr (HasVariant<Params>)
      rows.insert(rows.begin(),
                  {std::string(Params::variant_key), "", "a name",
                   "which one, with its own parameters: see 'gramloom list patterns'"});
    text += text_table(rows, "  ") + "\n";
  });
  return text;
}

std::string list_abilities() {
  std::string text = "| method |";
  std::string line = "|---|";
  for (const std::string_view ability : enum_names<Ability>) {
    if (ability == to_word(Ability::exemplar)) continue;
    text += fmt::format(" {} |", ability);
    line += "---|";
  }
  text += "\n" + line + "\n";
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    if (!Params::abilities.has(Ability::exemplar)) return;
    text += fmt::format("| `{}` |", Params::kind);
    for (std::size_t i = 1; i < enum_names<Ability>.size(); ++i)
      text += Params::abilities.has(static_cast<Ability>(i)) ? " yes |" : "  |";
    text += "\n";
  });
  return text;
}

std::string list_direction() {
  std::string text;
  for_each_direction(Direction(), [&]<class Entry>(const std::optional<Entry>&) {
    text += fmt::format("[{}]\n", Entry::section);
    text += text_table(parameter_rows<Entry>(), "  ") + "\n";
  });
  return text;
}

std::string list_patterns() {
  std::string text;
  for_each_alternative<Method>([&]<class Params>(std::type_identity<Params>) {
    if constexpr (HasVariant<Params>) {
      text +=
          fmt::format("Every {} = … of the kind '{}' has:\n", Params::variant_key, Params::kind);
      text += text_table(parameter_rows<Params>(), "  ") + "\n";
      text += list_textures<decltype(Params::texture)>();
    }
  });
  return text;
}

std::string list_networks() {
  std::vector<Row> rows;
  for (const auto& file : known_networks())
    rows.push_back({file.stem().string(), read_network(file).summary});
  return text_table(rows, "") + "\n";
}

std::string list_models() {
  std::string text;
  for_each_alternative<ModelRecipe>([&]<class Recipe>(std::type_identity<Recipe>) {
    text += fmt::format("A [[model]] of kind = \"{}\", {}, has:\n", Recipe::kind, Recipe::summary);
    text += text_table(parameter_rows<Recipe>(), "  ") + "\n";
  });
  std::vector<Row> rows;
  for (const auto& file : models_in_folder(".safetensors")) {
    std::string kind;
    try {
      kind = model_kind(file);
    } catch (const Error&) {
      continue;  // weights of others, such as VGG-19's
    }
    if (kind != "generator") {
      rows.push_back({file.stem().string(), kind, ""});
      continue;
    }
    std::vector<std::string> materials;
    for (const GeneratorMaterial& material : read_generator_description(file).materials)
      materials.push_back(material.name);
    rows.push_back({file.stem().string(), kind, fmt::format("of {}", fmt::join(materials, ", "))});
  }
  return text + "Trained models that come with gramloom:\n" + text_table(rows, "  ") + "\n";
}

std::string job_table(const Config& config, const Plan& plan) {
  const double available = available_memory();
  std::vector<Row> rows{{"job", "memory", "time", ""}};
  double seconds = 0;
  std::size_t count = 0;
  for (const auto& planned : plan.jobs) {
    if (!planned.selected) continue;
    ++count;
    const double job_seconds =
        planned.cost.seconds + planned.finishing.seconds + planned.scoring.seconds;
    const double bytes =
        program_memory(config.methods[planned.job.method].method) +
        std::max({planned.cost.bytes, planned.finishing.bytes, planned.scoring.bytes});
    seconds += job_seconds;
    rows.push_back({planned.name, memory_text(bytes), clock_text(job_seconds),
                    problem_of(config, plan, planned, available)});
  }
  for (const auto& diversity : plan.diversities) {
    seconds += diversity.cost.seconds;
    rows.push_back({diversity.name + " diversity",
                    memory_text(program_memory(QuiltingParams()) + diversity.cost.bytes),
                    clock_text(diversity.cost.seconds), problem_of(diversity, available)});
  }
  return text_table(rows, "") +
         fmt::format("{} {}, about {}\n", count, count == 1 ? "job" : "jobs", clock_text(seconds));
}

namespace {

template <class... Params>
std::string list_named() {
  return (fmt::format("{}: {}\n{}\n", Params::name, Params::summary,
                      text_table(parameter_rows<Params>(), "  ")) +
          ...);
}

}  // namespace

std::string list_maps() { return list_named<SurfaceParams, PhotoParams, PreviewParams>(); }

std::string list_simulation() { return list_named<SimulationParams, ClothParams>(); }

std::string list_metrics() {
  std::string text;
  std::vector<Metric> all(metrics().begin(), metrics().end());
  all.insert(all.end(), map_metrics().begin(), map_metrics().end());
  for (const Metric& metric : all) {
    text += fmt::format("{} ({}): {}\n", metric.name, metric.group, metric.meaning);
    text += fmt::format("  {}; {} is better; {}\n", metric.range,
                        metric.higher_is_better ? "more" : "less", metric.paper);
    text += fmt::format("  fooled by {}\n\n", metric.fooled_by);
  }
  return text;
}

}  // namespace gramloom
