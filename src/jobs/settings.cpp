#include "jobs/settings.h"

#include "io/field_values.h"
#include "jobs/job_preview.h"

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

// An exemplar and its maps; files by their name and content, so that it may lie elsewhere.
Json exemplar_settings(const ExemplarEntry& exemplar, const std::vector<std::string>& hashes) {
  Json settings{{"image", valid_utf8(exemplar.image.filename().string())},
                {"max_side", value_to_json(exemplar.max_side, {})},
                {"hash", hashes.at(0)}};
  std::size_t layer = 0;
  for (const auto& [name, file] : exemplar.maps) {
    Json& map = settings["maps"][name];
    map = {{"image", valid_utf8(file.image.filename().string())}, {"hash", hashes.at(++layer)}};
    if (file.kind) map["kind"] = to_word(*file.kind);
    if (file.green) map["green"] = to_word(*file.green);
  }
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

Json job_settings(const Config& config, const Job& job, const InputHashes& inputs) {
  const Method& method = config.methods[job.method].method;
  Json settings{{"method", method_to_json(method, config.file.parent_path())}};
  if (!inputs.method.empty()) settings["files"] = to_json_value(inputs.method);
  if (job.exemplar)
    settings["exemplar"] = exemplar_settings(config.exemplars[*job.exemplar], inputs.exemplar);
  settings["seed"] = job.seed;
  settings["size"] = value_to_json(config.size, {});
  settings["tile"] = value_to_json(config.tile, {});
  settings["format"] = value_to_json(config.format, {});
  settings["pixel_type"] = value_to_json(config.pixel_type, {});
  if (!maps_asked(config.surface).empty()) settings["surface"] = fields_to_json(config.surface, {});
  if (config.preview) {
    settings["preview"] = fields_to_json(*config.preview, config.file.parent_path());
    if (!inputs.preview.empty()) settings["preview"]["files"] = to_json_value(inputs.preview);
  }
  // As a record will hold it: a name may have bytes that are no UTF-8.
  return parse_json(to_text(settings));
}

InputHashes input_hashes(const Config& config, const Job& job, FileHashes& hashes) {
  InputHashes inputs;
  if (job.exemplar) inputs.exemplar = exemplar_hashes(config.exemplars[*job.exemplar], hashes);
  inputs.method = method_hashes(config.methods[job.method].method, hashes);
  inputs.preview = preview_hashes(config, hashes);
  return inputs;
}

Json config_to_json(const Config& config) {
  const fs::path folder = config.file.parent_path();
  Json json = fields_to_json(config, folder);
  json["baseline"] = fields_to_json(config.baseline, folder);
  if (!maps_asked(config.surface).empty()) json["surface"] = fields_to_json(config.surface, folder);
  if (config.preview) json["preview"] = fields_to_json(*config.preview, folder);
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

}  // namespace gramloom
