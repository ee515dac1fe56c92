#include "jobs/settings.h"

#include "core/hash.h"
#include "io/field_values.h"
#include "io/text_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// Those fields of a struct that are its own (not its sub-structs), as a JSON object.
template <class Struct>
Json fields_to_json(const Struct& value, const fs::path& folder) {
  Json json;
  for_each_field<Struct>([&](const auto& field) {
    json[std::string(field.name)] = value_to_json(value.*field.member, folder);
  });
  return json;
}

bool is_name(const fs::path&) { return false; }
bool is_name(const FileOrName& value) { return value.is_name(); }

// The content of every file that the method's parameters name.
Json hashes_of_files(const Method& method) {
  Json hashes = Json::object();
  std::visit(
      [&](const auto& params) {
        for_each_parameter(params, [&]<class T>(const auto& field, const T& value) {
          if constexpr (std::is_base_of_v<fs::path, T>)
            if (std::error_code ignored; !is_name(value) && fs::is_regular_file(value, ignored))
              hashes[std::string(field.name)] = file_hash(value);
        });
      },
      method);
  return hashes;
}

// An exemplar and its maps; files by their name and content, so that it may lie elsewhere.
Json exemplar_settings(const ExemplarEntry& exemplar, const std::vector<std::string>& hashes) {
  // Those of a file that cannot be read are not known, and its jobs fail.
  const auto hash = [&](std::size_t layer) { return layer < hashes.size() ? hashes[layer] : ""; };
  Json settings{{"image", exemplar.image.filename().string()},
                {"max_side", value_to_json(exemplar.max_side, {})},
                {"hash", hash(0)}};
  std::size_t layer = 0;
  for (const auto& [name, file] : exemplar.maps)
    settings["maps"][name] = {{"image", file.filename().string()}, {"hash", hash(++layer)}};
  return settings;
}

}  // namespace

Json method_to_json(const Method& method, const fs::path& folder) {
  Json json{{"kind", kind_of(method)}};
  std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (HasVariant<Params>)
          json[std::string(Params::variant_key)] =
              std::visit([]<class T>(const T&) { return std::string(T::name); }, params.texture);
        for_each_parameter(params, [&](const auto& field, const auto& value) {
          json[std::string(field.name)] = value_to_json(value, folder);
        });
      },
      method);
  return json;
}

Json job_settings(const Config& config, const Plan& plan, const Job& job) {
  const Method& method = config.methods[job.method].method;
  Json settings{{"method", method_to_json(method, config.file.parent_path())}};
  if (const Json files = hashes_of_files(method); !files.empty()) settings["files"] = files;
  if (job.exemplar)
    settings["exemplar"] =
        exemplar_settings(config.exemplars[*job.exemplar], plan.exemplars[*job.exemplar].hashes);
  settings["seed"] = job.seed;
  settings["size"] = value_to_json(config.size, {});
  settings["tile"] = value_to_json(config.tile, {});
  settings["format"] = value_to_json(config.format, {});
  settings["pixel_type"] = value_to_json(config.pixel_type, {});
  // As a record will hold it: a name may have bytes that are no UTF-8.
  return Json::parse(settings.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json config_to_json(const Config& config) {
  const fs::path folder = config.file.parent_path();
  Json json = fields_to_json(config, folder);
  json["baseline"] = fields_to_json(config.baseline, folder);
  json["exemplar"] = Json::array();
  for (const auto& exemplar : config.exemplars) {
    Json entry{{"name", exemplar.name}};
    entry.update(fields_to_json(exemplar, folder));
    json["exemplar"].push_back(entry);
  }
  json["method"] = Json::array();
  for (const auto& method : config.methods) {
    Json entry{{"name", method.name}};
    entry.update(method_to_json(method.method, folder));
    json["method"].push_back(entry);
  }
  return json;
}

std::string file_hash(const fs::path& path) { return hash_of(read_text(path)); }

}  // namespace gramloom
