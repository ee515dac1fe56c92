#include "jobs/settings.h"

#include <map>

#include "io/field_values.h"
#include "jobs/job_preview.h"
#include "surface/maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

template <class T>
void add_value(const FieldText& field, const T& value, const fs::path& folder, Json& json) {
  json[std::string(field.name)] = value_to_json(value, folder);
}

// Those fields of a struct that are its own (not its sub-structs), as a JSON object.
template <class Struct>
Json fields_to_json(const Struct& params, const fs::path& folder) {
  Json json;
  for_each_value(params, [&](const FieldText& field, const auto& value) {
    add_value(field, value, folder, json);
  });
  return json;
}

// A file by its name and content, so that it may lie elsewhere.
Json file_settings(const fs::path& file, const std::string& hash) {
  return {{"image", valid_utf8(file.filename().string())}, {"hash", hash}};
}

// A picture of an exemplar; `hash` is of its first file, and then behind the last.
Json picture_settings(const ExemplarPicture& picture,
                      std::vector<std::string>::const_iterator& hash) {
  Json settings = file_settings(picture.image, *hash++);
  for (const auto& [name, file] : picture.maps) {
    Json& map = settings["maps"][name];
    map = file_settings(file.image, *hash++);
    if (file.kind) map["kind"] = to_word(*file.kind);
    if (file.green) map["green"] = to_word(*file.green);
  }
  if (picture.mask.is_name())
    settings["mask"] = picture.mask.string();
  else if (!picture.mask.empty())
    settings["mask"] = file_settings(picture.mask, *hash++);
  if (!picture.guide.empty()) settings["guide"] = file_settings(picture.guide, *hash++);
  return settings;
}

Json exemplar_settings(const ExemplarEntry& exemplar, const std::vector<std::string>& hashes) {
  auto hash = hashes.begin();
  Json settings = picture_settings(exemplar, hash);
  settings["max_side"] = value_to_json(exemplar.max_side, {});
  if (exemplar.is_filled) settings["filled"] = true;  // what is to be made is masked
  for (const ExemplarPicture& picture : exemplar.more)
    settings["more"].push_back(picture_settings(picture, hash));
  return settings;
}

// [guide], [mix], [turn] and [fill], each under its name. Files as above, all at the end.
void add_direction(const Direction& direction, const Named<std::string>& hashes, Json& settings) {
  for_each_direction(direction, [&]<class Entry>(const std::optional<Entry>& entry) {
    if (!entry) return;
    Json& section = settings[std::string(Entry::section)];
    section = Json::object();
    for_each_value(*entry, [&]<class T>(const FieldText& field, const T& value) {
      constexpr bool file = std::is_base_of_v<fs::path, T> ||
                            std::is_same_v<T, std::vector<fs::path>> || is_named_files<T>;
      if constexpr (!file) add_value(field, value, {}, section);
    });
    for (const auto& [key, hash] : hashes)
      if (key.starts_with(fmt::format("{}.", Entry::section)))
        section["files"].push_back({key, hash});
  });
  if (direction.fill && direction.fill->mask.is_name())
    settings["fill"]["mask"] = direction.fill->mask.string();
}

Json preview_settings(const PreviewEntry& preview, const Named<std::string>& files,
                      const fs::path& folder) {
  const PreviewParams& params = preview;
  Json settings = fields_to_json(params, folder);
  if (!preview.second.empty()) settings["second"] = value_to_json(preview.second, folder);
  if (!files.empty()) settings["files"] = to_json_value(files);
  return settings;
}

// The one without a name as "preview", the others in "previews". Neither their order in the config
// counts nor which other jobs have them.
void add_previews(const std::vector<const PreviewEntry*>& previews,
                  const Named<Named<std::string>>& files, const fs::path& folder, Json& settings) {
  std::map<std::string, Json> named;
  for (std::size_t i = 0; i < previews.size(); ++i) {
    const std::string& name = previews[i]->name;
    (name.empty() ? settings["preview"] : named[name]) =
        preview_settings(*previews[i], files[i].second, folder);
  }
  for (auto& [name, own] : named) settings["previews"][name] = std::move(own);
}

}  // namespace

Json method_to_json(const Method& method, const fs::path& folder) {
  Json json{{"kind", kind_of(method)}};
  std::visit(
      [&]<class Params>(const Params& params) {
        if constexpr (HasVariant<Params>)
          json[std::string(Params::variant_key)] =
              std::visit([]<class T>(const T&) { return std::string(T::name); }, params.texture);
        for_each_parameter(params, [&](const FieldText& field, const auto& value) {
          add_value(field, value, folder, json);
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
  add_direction(config.direction, inputs.direction, settings);
  settings["seed"] = job.seed;
  settings["size"] = value_to_json(config.size, {});
  settings["tile"] = value_to_json(config.tile, {});
  settings["format"] = value_to_json(config.format, {});
  settings["pixel_type"] = value_to_json(config.pixel_type, {});
  if (config.coordinates) settings["coordinates"] = true;
  if (makes_maps(config, job)) settings["surface"] = fields_to_json(config.surface, {});
  add_previews(previews_of(config, job), inputs.previews, config.file.parent_path(), settings);
  // As a record will hold it: a name may have bytes that are no UTF-8.
  return parse_json(to_text(settings));
}

bool makes_maps(const Config& config, const Job& job) {
  const bool asked = !maps_asked(config.surface).empty();
  if (!job.exemplar) return asked;
  return config.surface.guess ||
         (asked && !height_among(config.exemplars[*job.exemplar].maps, config.surface).empty());
}

Named<Named<std::string>> preview_hashes(const Config& config, const Job& job, FileHashes& hashes) {
  Named<Named<std::string>> result;
  for (const PreviewEntry* preview : previews_of(config, job))
    result.push_back({preview->name, preview_hashes(*preview, hashes)});
  return result;
}

InputHashes input_hashes(const Config& config, const Job& job, FileHashes& hashes) {
  InputHashes inputs;
  if (job.exemplar) inputs.exemplar = exemplar_hashes(config.exemplars[*job.exemplar], hashes);
  inputs.direction = direction_hashes(config.direction, hashes);
  inputs.method = method_hashes(config.methods[job.method].method, hashes);
  inputs.previews = preview_hashes(config, job, hashes);
  return inputs;
}

Json config_to_json(const Config& config) {
  const fs::path folder = config.file.parent_path();
  Json json = fields_to_json(config, folder);
  json["baseline"] = fields_to_json(config.baseline, folder);
  if (makes_any(config.surface)) json["surface"] = fields_to_json(config.surface, folder);
  for (const PreviewEntry& preview : config.previews)
    json["preview"].push_back(fields_to_json(preview, folder));
  for_each_direction(config.direction, [&]<class Entry>(const std::optional<Entry>& entry) {
    if (entry) json[std::string(Entry::section)] = fields_to_json(*entry, folder);
  });
  json["exemplar"] = Json::array();
  for (const auto& exemplar : config.exemplars) {
    if (exemplar.is_filled) continue;  // [fill] says it
    Json entry{{"name", exemplar.name}};
    entry.update(fields_to_json(exemplar, folder));
    for (const ExemplarPicture& picture : exemplar.more)
      entry["more"].push_back(fields_to_json(picture, folder));
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
