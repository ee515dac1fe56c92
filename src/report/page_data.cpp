#include "report/page_data.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "metrics/scores.h"
#include "report/preview.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;
using nlohmann::literals::operator""_json_pointer;

constexpr std::size_t trace_points = 300;

// What the folder holds of one exemplar.
struct Source {
  Json shown;        // its entry in the data
  double white = 1;  // of its picture
  std::map<std::string, double> map_whites;

  double white_of_view(const std::string& label) const {
    const auto map = map_whites.find(label);
    return map == map_whites.end() ? white : map->second;
  }
};

Json metrics_to_json() {
  Json list = Json::array();
  for (const Metric& metric : metrics())
    list.push_back({{"name", metric.name},
                    {"group", metric.group},
                    {"meaning", metric.meaning},
                    {"range", metric.range},
                    {"higher_is_better", metric.higher_is_better},
                    {"paper", metric.paper},
                    {"fooled_by", metric.fooled_by}});
  return list;
}

Json part(const Json& object, std::initializer_list<const char*> keys) {
  Json chosen = Json::object();
  for (const auto* key : keys)
    if (object.contains(key)) chosen[key] = object[key];
  return chosen;
}

// The exemplar as the methods saw it: the run keeps it as exemplar.<its format> and its maps as
// exemplar_<map>.<its format>: "exemplar", "exemplar_height".
std::string exemplar_file(const fs::path& folder, const std::string& name,
                          const std::string& stem) {
  std::error_code ignored;
  for (const auto* extension : {".png", ".exr", ".tif"})
    if (const std::string file = fmt::format("{}/{}{}", name, stem, extension);
        fs::is_regular_file(folder / file, ignored))
      return file;
  return "";
}

// What the config says of the exemplar; its paths are relative to the config.
Json exemplar_in_config(const Json& run, const std::string& name) {
  for (const auto& exemplar : run.value("/settings/exemplar"_json_pointer, Json::array()))
    if (exemplar.value("name", "") == name) return exemplar;
  return Json::object();
}

// The maps of the exemplar that the folder holds.
void read_maps(const RunOnDisk& run, const std::string& name, Source& source, Json& trouble) {
  for (const auto& [map, path] : source.shown["maps"].items()) {
    const std::string file = exemplar_file(run.folder, name, "exemplar_" + map);
    if (file.empty()) continue;
    try {
      const double white = white_of(read_image(run.folder / file));
      source.map_whites[map] = white;
      source.shown["map_pictures"].push_back(
          {{"label", map}, {"file", shown_file(run.folder, file, white)}});
    } catch (const std::exception& error) {
      trouble.push_back(error.what());
    }
  }
}

Source read_source(const RunOnDisk& run, const std::string& name, Json& trouble) {
  const Json config = exemplar_in_config(run.run, name);
  Source source;
  source.shown = {{"name", name},
                  {"picture", nullptr},
                  {"image", config.value("image", Json())},
                  {"maps", config.value("maps", Json::object())},
                  {"map_pictures", Json::array()}};
  read_maps(run, name, source, trouble);
  const std::string file = exemplar_file(run.folder, name, "exemplar");
  if (file.empty()) return source;
  try {
    const ImageFile exemplar = read_image(run.folder / file);
    source.white = white_of(exemplar);
    source.shown["picture"] = {{"file", shown_file(run.folder, file, source.white)},
                               {"width", exemplar.image.width},
                               {"height", exemplar.image.height}};
  } catch (const std::exception& error) {
    trouble.push_back(error.what());
  }
  return source;
}

// "seed1_height.png" of the job "…/seed1" is its map "height".
std::string label_of(const std::string& job, const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const std::string own = fs::path(job).filename().string() + "_";
  return stem.starts_with(own) ? stem.substr(own.size()) : "picture";
}

Json pictures_of(const RunOnDisk& run, const JobOnDisk& job, const Source& source, Json& trouble) {
  Json pictures = Json::array();
  for (const auto& file : job.record.value("files", Json::array())) {
    try {
      const std::string name = file.get<std::string>();
      if (fs::path(name).filename() != name) throw Error("{}: {} is elsewhere", job.name, name);
      const std::string path = (fs::path(job.name).parent_path() / name).generic_string();
      const std::string label = label_of(job.name, name);
      pictures.push_back(
          {{"label", label}, {"file", shown_file(run.folder, path, source.white_of_view(label))}});
    } catch (const std::exception& error) {
      trouble.push_back(error.what());
    }
  }
  return pictures;
}

// The file that a record names, if it lies in the folder.
Json file_in_folder(const RunOnDisk& run, const Json& name) {
  if (!name.is_string()) return nullptr;
  const fs::path path = fs::path(name.get<std::string>()).lexically_normal();
  std::error_code ignored;
  const bool inside = !path.empty() && path.is_relative() && *path.begin() != "..";
  return inside && fs::is_regular_file(run.folder / path, ignored) ? Json(path.generic_string())
                                                                   : Json(nullptr);
}

Json job_to_json(const RunOnDisk& run, const JobOnDisk& job, const Source& source, Json& trouble) {
  Json shown{{"name", job.name}};
  shown.update(
      part(job.record, {"exemplar", "method", "kind", "seed", "width", "height", "status", "error",
                        "seconds", "peak_memory_mb", "settings", "metrics", "score_error"}));
  shown["pictures"] = pictures_of(run, job, source, trouble);
  shown["copy_map"] = file_in_folder(run, job.record.value("copy_map", Json()));
  shown["trace"] = job.trace.rows.empty() ? Json() : thin_trace(job.trace, trace_points);
  return shown;
}

// The config's name, which is the folder's unless the user chose another one.
std::string title_of(const RunOnDisk& run) {
  const std::string config = fs::path(run.run.value("config", "")).stem().string();
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
  Json methods = Json::array();
  Json jobs = Json::array();
  std::map<std::string, Source> sources;
  for (const JobOnDisk& job : run.jobs) {
    const std::string exemplar = job.record.at("exemplar");
    if (!sources.contains(exemplar)) {
      sources[exemplar] = read_source(run, exemplar, trouble);
      exemplars.push_back(sources[exemplar].shown);
    }
    if (const Json& method = job.record.at("method");
        std::find(methods.begin(), methods.end(), method) == methods.end())
      methods.push_back(method);
    jobs.push_back(job_to_json(run, job, sources[exemplar], trouble));
  }
  return {{"title", title_of(run)},
          {"run", part(run.run, {"date", "command", "config", "set", "versions", "machine"})},
          {"trouble", trouble},
          {"metrics", metrics_to_json()},
          {"exemplars", exemplars},
          {"methods", methods},
          {"jobs", jobs},
          {"diversity", run.run.value("diversity", Json::array())}};
}

}  // namespace gramloom
