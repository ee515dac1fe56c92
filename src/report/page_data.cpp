#include "report/page_data.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/hash.h"
#include "io/field_values.h"
#include "io/json_fields.h"
#include "metrics/map_scores.h"
#include "report/baseline_view.h"
#include "report/live_view.h"
#include "report/preview.h"
#include "report/sequence_view.h"
#include "report/surface_view.h"
#include "report/training_view.h"
#include "runs/job_files.h"
#include "runs/job_maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t trace_points = 300;

// What the folder holds of one exemplar.
struct ShownExemplar {
  Json shown;        // its entry in the data
  double white = 1;  // of its picture
  std::map<std::string, double> map_whites;

  double white_of_view(const std::string& label) const {
    const auto map = map_whites.find(label);
    return map == map_whites.end() ? white : map->second;
  }
};

Json metrics_to_json(std::span<const Metric> all) {
  Json list = Json::array();
  for (const Metric& metric : all)
    list.push_back({{"name", metric.name},
                    {"group", metric.group},
                    {"meaning", metric.meaning},
                    {"range", metric.range},
                    {"higher_is_better", metric.higher_is_better},
                    {"paper", metric.paper},
                    {"fooled_by", metric.fooled_by}});
  return list;
}

// What the config says of the exemplar; its paths are relative to the config.
Json exemplar_in_config(const RunRecord& run, const std::string& name) {
  if (!run.settings.is_object()) return Json::object();
  for (const auto& exemplar : run.settings.value("exemplar", Json::array()))
    if (exemplar.value("name", "") == name) return exemplar;
  return Json::object();
}

// The maps of the exemplar that the folder holds.
void read_maps(const RunOnDisk& run, const std::string& name, ShownExemplar& source,
               Json& trouble) {
  for (const auto& [map, path] : source.shown["maps"].items()) {
    const std::string file = kept_exemplar(run.folder, name, map);
    if (file.empty()) continue;
    try {
      const double white = white_of(read_image(run.folder / file));
      source.map_whites[map] = white;
      source.shown["map_pictures"].push_back(
          {{"label", map}, {"file", shown_file(run.folder, file, white)}});
    } catch (const std::exception& error) {
      trouble.push_back(message_of(error));
    }
  }
}

// The other pictures of the exemplar that the folder holds, its masks and guides, and what was
// asked of the texture.
void add_directing_pictures(const RunOnDisk& run, const std::string& name, ShownExemplar& source) {
  const auto add = [&](const std::string& label, const std::string& file) {
    const std::string path = name + "/" + file;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(run.folder / path, ignored))
      source.shown["map_pictures"].push_back({{"label", label}, {"file", path}});
  };
  const std::size_t pictures = 1 + source.shown["more"].size();
  for (std::size_t i = 0; i < pictures; ++i) {
    const std::string which = i > 0 ? fmt::format("picture {}", i + 1) : "";
    const std::string before = i > 0 ? which + ": " : "";
    const std::string stem = kept_stem(i);
    if (i > 0) add(which, stem + ".png");
    add(before + "what may be used", stem + "_usable.png");
    add(before + "guide", stem + "_guide.png");
  }
  add("the texture's guide", "target_guide.png");
  add("the texture's weights", "target_weights.png");
  add("what is made anew", "target_mask.png");
  add("how far it is turned", "target_angle.png");
  add("how large it is", "target_scale.png");
}

// Adds a map to a view if that knows it and has none of its kind. The record says of normals where
// their green points.
void add_map(SurfaceView& view, const JobRecord& record, const std::string& map,
             const std::string& file) {
  const std::string known = material_map_of(record, map);
  if (known.empty() || !view.files.emplace(known, file).second) return;
  if (const auto green = record.normals.find(map); green != record.normals.end())
    view.green = green->second;
}

// The copies of an exemplar and its maps for the lit view; a job's record knows its normals.
Json exemplar_view(const RunOnDisk& run, const std::string& name, const std::string& picture,
                   const ShownExemplar& source) {
  SurfaceView view{{{"colour", picture}}, source.white};
  const auto job = std::ranges::find_if(run.jobs, [&](const JobOnDisk& any) {
    return any.record.exemplar == name && any.record.status == Status::done;
  });
  const JobRecord record = job == run.jobs.end() ? JobRecord() : job->record;
  for (const auto& [map, path] : source.shown["maps"].items())
    if (const std::string file = kept_exemplar(run.folder, name, map); !file.empty())
      add_map(view, record, map, file);
  return surface_view_file(run.folder, name + "/exemplar", view);
}

ShownExemplar read_source(const RunOnDisk& run, const std::string& name, Json& trouble) {
  const Json config = exemplar_in_config(run.run, name);
  ShownExemplar source;
  source.shown = {{"name", name},
                  {"picture", nullptr},
                  {"view", nullptr},
                  {"image", config.value("image", Json())},
                  {"maps", config.value("maps", Json::object())},
                  {"mask", config.value("mask", "")},
                  {"guide", config.value("guide", "")},
                  {"more", config.value("more", Json::array())},
                  {"map_pictures", Json::array()}};
  read_maps(run, name, source, trouble);
  add_directing_pictures(run, name, source);
  const std::string file = kept_exemplar(run.folder, name);
  if (file.empty()) return source;
  try {
    const ImageFile exemplar = read_image(run.folder / file);
    source.white = white_of(exemplar);
    source.shown["view"] = exemplar_view(run, name, file, source);
    source.shown["picture"] = {{"file", shown_file(run.folder, file, source.white)},
                               {"width", exemplar.image.width},
                               {"height", exemplar.image.height}};
  } catch (const std::exception& error) {
    trouble.push_back(message_of(error));
  }
  return source;
}

Json pictures_of(const RunOnDisk& run, const JobOnDisk& job, const ShownExemplar& source,
                 Json& trouble) {
  Json pictures = Json::array();
  for (const std::string& name : job.record.files) {
    try {
      if (fs::path(name).filename() != name) throw Error("{}: {} is elsewhere", job.name, name);
      const std::string path = (fs::path(job.name).parent_path() / name).generic_string();
      const std::string label = label_of_file(job.name, name);
      pictures.push_back(
          {{"label", label}, {"file", shown_file(run.folder, path, source.white_of_view(label))}});
    } catch (const std::exception& error) {
      trouble.push_back(message_of(error));
    }
  }
  return pictures;
}

// The file that a record names, if it lies in the folder.
Json file_in_folder(const RunOnDisk& run, const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  std::error_code ignored;
  const bool inside = !path.empty() && path.is_relative() && *path.begin() != "..";
  return inside && fs::is_regular_file(run.folder / path, ignored) ? Json(path.generic_string())
                                                                   : Json(nullptr);
}

// What the command that makes a result again needs to know. A record of version 1 does not: there
// what the run says holds.
Json origin_of(const RunOnDisk& run, const JobRecord& record) {
  const bool known = !record.config.empty();
  const RunRecord& all = run.run;
  const bool edited = known && record.config_hash != hash_of(all.config_text);
  return {{"config", known ? record.config : all.config},
          {"set", known ? record.set : all.set},
          {"threads", known ? record.machine.threads : all.machine.threads},
          {"edited", edited}};
}

// The copies of a job's pictures for the lit view, or null.
Json view_of(const RunOnDisk& run, const JobOnDisk& job, const ShownExemplar& source,
             Json& trouble) {
  const JobRecord& record = job.record;
  if (!is_finished(record, (run.folder / job.name).parent_path())) return nullptr;
  const Json settings = record.settings.is_object() ? record.settings : Json::object();
  const auto table = [](const Json& json, const std::string& key) {
    return json.contains(key) && json.at(key).is_object() ? json.at(key) : Json::object();
  };
  SurfaceView view{{}, source.white};
  view.tile = tile_of(settings);
  view.strength = table(settings, "surface").value("strength", view.strength);
  for (const std::string& name : record.files) {
    if (fs::path(name).filename() != name) return nullptr;
    const std::string path = (fs::path(job.name).parent_path() / name).generic_string();
    if (name == record.files.front())
      view.files["colour"] = path;
    else
      add_map(view, record, map_of_file(job.name, name), path);
  }
  try {
    return surface_view_file(run.folder, job.name, view);
  } catch (const std::exception& error) {
    trouble.push_back(message_of(error));
    return nullptr;
  }
}

// What makes a job's picture live, or null.
Json live_of(const RunOnDisk& run, const JobOnDisk& job, Json& trouble) {
  if (!is_finished(job.record, (run.folder / job.name).parent_path())) return nullptr;
  try {
    return live_view(run, job);
  } catch (const std::exception& error) {
    trouble.push_back(message_of(error));
    return nullptr;
  }
}

Json job_to_json(const RunOnDisk& run, const JobOnDisk& job, const ShownExemplar& source,
                 Json& trouble) {
  const JobRecord& record = job.record;
  return {{"name", job.name},
          {"exemplar", record.exemplar},
          {"method", record.method},
          {"kind", record.kind},
          {"seed", record.seed},
          {"width", record.size.width},
          {"height", record.size.height},
          {"status", to_word(record.status)},
          {"error", record.error},
          {"seconds", record.seconds},
          {"peak_memory_mb", record.peak_memory_mb},
          {"settings", record.settings},
          {"metrics", to_json_value(record.metrics)},
          {"map_metrics", to_json_value(record.map_metrics)},
          {"score_error", record.score_error},
          {"origin", origin_of(run, record)},
          {"machine", to_json_value(record.machine)},
          {"pictures", pictures_of(run, job, source, trouble)},
          {"view", view_of(run, job, source, trouble)},
          {"live", live_of(run, job, trouble)},
          {"copy_map", file_in_folder(run, record.copy_map)},
          {"trace", job.trace.rows.empty() ? Json() : thin_trace(job.trace, trace_points)}};
}

std::map<std::string, const ChangedJob*> changes_by_job(
    const std::optional<ComparisonRecord>& comparison) {
  std::map<std::string, const ChangedJob*> changes;
  if (comparison)
    for (const ChangedJob& job : comparison->jobs) changes[job.job] = &job;
  return changes;
}

// What directs the textures, as the config has it; paths are relative to that.
Json direction_of(const RunRecord& run) {
  Json direction = Json::object();
  for (const char* section : {"guide", "mix", "turn", "fill"})
    if (run.settings.is_object() && run.settings.contains(section))
      direction[section] = run.settings[section];
  return direction;
}

Json run_to_json(const RunRecord& run) {
  return {{"date", run.date},
          {"command", run.command},
          {"config", run.config},
          {"set", run.set},
          {"direction", direction_of(run)},
          {"versions", to_json_value(run.versions)},
          {"machine", to_json_value(run.machine)}};
}

// The config's name, which is the folder's unless the user chose another one.
std::string title_of(const RunOnDisk& run) {
  const std::string config = fs::path(run.run.config).stem().string();
  if (!config.empty()) return config;
  return fs::absolute(run.folder).lexically_normal().parent_path().filename().string();
}

}  // namespace

Json thin_trace(const Trace& trace, std::size_t most) {
  Json steps = Json::array();
  Json seconds = Json::array();
  Json loss = Json::array();
  const std::size_t count = trace.rows.size();
  const std::size_t points = std::min(count, most);
  for (std::size_t i = 0; i < points; ++i) {
    const TraceRow& row = trace.rows[points < 2 ? 0 : i * (count - 1) / (points - 1)];
    steps.push_back(row.step);
    seconds.push_back(row.seconds);
    loss.push_back(row.loss);
  }
  return {{"steps", steps}, {"seconds", seconds}, {"loss", loss}};
}

Json page_data(const RunOnDisk& run) {
  Json trouble = Json::array();
  Json exemplars = Json::array();
  std::vector<std::string> methods;
  Json jobs = Json::array();
  std::map<std::string, ShownExemplar> sources;
  const auto comparison = read_comparison(run, trouble);
  const auto changed = changes_by_job(comparison);
  for (const JobOnDisk& job : run.jobs) {
    const std::string& exemplar = job.record.exemplar;
    if (!sources.contains(exemplar)) {
      sources[exemplar] = read_source(run, exemplar, trouble);
      exemplars.push_back(sources[exemplar].shown);
    }
    if (const std::string& method = job.record.method;
        std::find(methods.begin(), methods.end(), method) == methods.end())
      methods.push_back(method);
    jobs.push_back(job_to_json(run, job, sources[exemplar], trouble));
    if (const auto found = changed.find(job.name); found != changed.end())
      jobs.back()["before"] = baseline_job(
          run, *comparison, *found->second,
          [&](const std::string& label) { return sources[exemplar].white_of_view(label); },
          trouble);
  }
  const Json sequences = sequence_views(run, trouble);
  const Json trainings = training_views(run, trouble);
  return {{"title", title_of(run)},
          {"run", run_to_json(run.run)},
          {"trouble", trouble},
          {"metrics", metrics_to_json(metrics())},
          {"exemplars", exemplars},
          {"methods", methods},
          {"map_metrics", metrics_to_json(map_metrics())},
          {"baseline", comparison ? baseline_summary(*comparison) : Json()},
          {"sequences", sequences},
          {"trainings", trainings},
          {"jobs", jobs},
          {"diversity", to_json_value(run.diversity)}};
}

}  // namespace gramloom
