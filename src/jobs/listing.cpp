#include "jobs/listing.h"

#include <algorithm>

#include "core/variants.h"
#include "io/models_folder.h"
#include "jobs/expectation.h"
#include "jobs/key_lists.h"
#include "jobs/machine_speed.h"
#include "jobs/memory.h"
#include "jobs/progress_bar.h"
#include "jobs/text_table.h"
#include "learnt/generator_model.h"
#include "learnt/model_file.h"
#include "metrics/map_scores.h"
#include "neural/network/network_description.h"

namespace gramloom {

namespace {

// A row for each key.
std::vector<Row> rows_of(const KeyList& list) {
  std::vector<Row> rows;
  for (const Key& key : list.keys) {
    const std::string standard = default_text(key);
    rows.push_back(
        {key.name, standard.empty() ? "" : "= " + standard, key.allowed, meaning_of(key)});
  }
  return rows;
}

// A summary, then a row for each key, of every list.
std::string text_of(const std::vector<KeyList>& lists) {
  std::string text;
  for (const KeyList& list : lists)
    text += fmt::format("{}: {}\n{}\n", list.name, list.summary, text_table(rows_of(list), "  "));
  return text;
}

// "can: exemplar, mask", or what a method of formulas takes.
std::string ability_line(const KeyList& method) {
  return method.abilities.empty() ? "takes no exemplar"
                                  : fmt::format("can: {}", fmt::join(method.abilities, ", "));
}

struct TrainedModel {
  std::string name, kind;
  std::vector<std::string> materials;
};

// Those of the models folder.
std::vector<TrainedModel> trained_models() {
  std::vector<TrainedModel> models;
  for (const auto& file : models_in_folder(".safetensors")) {
    TrainedModel model{file.stem().string(), "", {}};
    try {
      model.kind = model_kind(file);
    } catch (const Error&) {
      continue;  // weights of others, such as VGG-19's
    }
    if (model.kind == "generator")
      for (const GeneratorMaterial& material : read_generator_description(file).materials)
        model.materials.push_back(material.name);
    models.push_back(std::move(model));
  }
  return models;
}

std::vector<Metric> all_metrics() {
  std::vector<Metric> all(metrics().begin(), metrics().end());
  all.insert(all.end(), map_metrics().begin(), map_metrics().end());
  return all;
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

struct Expectations {
  std::vector<Expectation> jobs, diversities;

  // Of all of them, with the start of the program, which opens the libraries of pictures.
  double seconds() const {
    double sum = 0.25;
    for (const auto* list : {&jobs, &diversities})
      for (const Expectation& one : *list) sum += one.seconds.value_or(0);
    return sum;
  }
};

// Of the job called `name`; what is not known is left out.
Row row_of(const std::string& name, const Expectation& expected) {
  return {name, expected.memory ? memory_text(*expected.memory) : "",
          expected.seconds ? clock_text(*expected.seconds) : "", expected.problem};
}

bool multiplies_matrices(const Plan& plan) {
  return std::ranges::any_of(plan.jobs, [](const PlannedJob& planned) {
    return planned.selected && planned.cost.work.operations > 0;
  });
}

Expectations expectations_of(const Config& config, const Plan& plan) {
  const double available = available_memory();
  const Speed speed = machine_speed(multiplies_matrices(plan));
  Expectations expected;
  for (const PlannedJob& planned : plan.jobs) {
    if (!planned.selected) continue;
    if (!planned.error.empty()) {
      expected.jobs.push_back({planned.name, {}, {}, problem_of(config, plan, planned, available)});
      continue;
    }
    expected.jobs.push_back(
        {planned.name,
         program_memory(config.methods[planned.job.method].method) +
             std::max({planned.cost.bytes, planned.finishing.bytes, planned.scoring.bytes}),
         seconds(planned.cost.work + planned.finishing.work + planned.scoring.work, speed),
         problem_of(config, plan, planned, available)});
  }
  for (const PlannedDiversity& diversity : plan.diversities)
    expected.diversities.push_back(
        {diversity.name, program_memory(QuiltingParams()) + diversity.cost.bytes,
         seconds(diversity.cost.work, speed), problem_of(diversity, available)});
  return expected;
}

}  // namespace

std::string list_methods() {
  std::string text;
  for (const KeyList& method : method_lists())
    text += fmt::format("{}: {}\n  {}\n{}\n", method.name, method.summary, ability_line(method),
                        text_table(rows_of(method), "  "));
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
  for (const KeyList& list : direction_lists())
    text += fmt::format("[{}]\n{}\n", list.name, text_table(rows_of(list), "  "));
  return text;
}

std::string list_patterns() {
  std::string text;
  for (const KeyList& method : method_lists()) {
    const auto& keys = method.keys;
    if (method.name != ProceduralParams::kind) continue;
    text += fmt::format("Every {} = … of the kind '{}' has:\n", keys.front().name, method.name);
    text += text_table(rows_of({method.name, "", {}, {keys.begin() + 1, keys.end()}}), "  ") + "\n";
  }
  return text + text_of(texture_lists());
}

std::string list_networks() {
  std::vector<Row> rows;
  for (const auto& file : known_networks())
    rows.push_back({file.stem().string(), read_network(file).summary});
  return text_table(rows, "") + "\n";
}

std::vector<std::string> network_names() {
  std::vector<std::string> names;
  for (const auto& file : known_networks()) names.push_back(file.stem().string());
  return names;
}

std::string list_models() {
  std::string text;
  for (const KeyList& recipe : model_lists()) {
    text += fmt::format("A [[model]] of kind = \"{}\", {}, has:\n", recipe.name, recipe.summary);
    text += text_table(rows_of(recipe), "  ") + "\n";
  }
  std::vector<Row> rows;
  for (const TrainedModel& model : trained_models())
    rows.push_back(
        {model.name, model.kind,
         model.materials.empty() ? "" : fmt::format("of {}", fmt::join(model.materials, ", "))});
  return text + "Trained models that come with gramloom:\n" + text_table(rows, "  ") + "\n";
}

Json abilities_json() {
  Json json;
  for (const KeyList& method : method_lists()) json[method.name] = method.abilities;
  return json;
}

Json networks_json() {
  auto json = Json::array();
  for (const auto& file : known_networks())
    json.push_back({{"name", file.stem().string()}, {"summary", read_network(file).summary}});
  return json;
}

Json models_json() {
  auto trained = Json::array();
  for (const TrainedModel& model : trained_models())
    trained.push_back({{"name", model.name}, {"kind", model.kind}, {"materials", model.materials}});
  return {{"recipes", to_json_value(model_lists())}, {"trained", trained}};
}

Json metrics_json() {
  auto json = Json::array();
  for (const Metric& metric : all_metrics())
    json.push_back({{"name", metric.name},
                    {"group", metric.group},
                    {"description", metric.meaning},
                    {"range", metric.range},
                    {"higher_is_better", metric.higher_is_better},
                    {"paper", metric.paper},
                    {"fooled_by", metric.fooled_by}});
  return json;
}

std::string job_table(const Config& config, const Plan& plan) {
  const Expectations expected = expectations_of(config, plan);
  std::vector<Row> rows{{"job", "memory", "time", ""}};
  const auto add = [&](const std::vector<Expectation>& list, const std::string& what) {
    for (const Expectation& one : list) rows.push_back(row_of(one.name + what, one));
  };
  add(expected.jobs, "");
  add(expected.diversities, " diversity");
  const std::size_t count = expected.jobs.size();
  return text_table(rows, "") + fmt::format("{} {}, about {}\n", count, count == 1 ? "job" : "jobs",
                                            clock_text(expected.seconds()));
}

std::string lesson_table(const std::vector<Expectation>& lessons) {
  if (lessons.empty()) return "";
  std::vector<Row> rows{{"model to train", "memory", "time", ""}};
  for (const Expectation& lesson : lessons) rows.push_back(row_of(lesson.name, lesson));
  return text_table(rows, "") + "\n";
}

Json jobs_json(const Config& config, const Plan& plan) {
  const Expectations expected = expectations_of(config, plan);
  return {{"jobs", to_json_value(expected.jobs)},
          {"diversities", to_json_value(expected.diversities)},
          {"seconds", expected.seconds()}};
}

std::string list_maps() { return text_of(map_lists()); }

std::string list_simulation() { return text_of(simulation_lists()); }

std::string list_metrics() {
  std::string text;
  for (const Metric& metric : all_metrics()) {
    text += fmt::format("{} ({}): {}\n", metric.name, metric.group, metric.meaning);
    text += fmt::format("  {}; {} is better; {}\n", metric.range,
                        metric.higher_is_better ? "more" : "less", metric.paper);
    text += fmt::format("  fooled by {}\n\n", metric.fooled_by);
  }
  return text;
}

}  // namespace gramloom
