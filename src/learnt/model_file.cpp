#include "learnt/model_file.h"

#include <cmath>

#include "core/error.h"

namespace gramloom {

namespace {

Json read_header(const std::filesystem::path& file) {
  const auto metadata = read_metadata(file);
  const auto found = metadata.find("gramloom");
  if (found == metadata.end())
    throw Error("{}: is no model that gramloom trained: its metadata has no 'gramloom'",
                file.string());
  try {
    return parse_json(found->second);
  } catch (const Error& error) {
    throw Error("{}: its description: {}", file.string(), error.what());
  }
}

std::string kind_in(const Json& json, const std::filesystem::path& file) {
  const JsonPlace place{file.string()};
  if (!json.is_object()) wrong_json(json, place, "an object");
  return from_json_value<std::string>(required_key(json, "kind", place), place.at("kind"));
}

}  // namespace

std::string model_kind(const std::filesystem::path& file) {
  return kind_in(read_header(file), file);
}

Json read_description_json(const std::filesystem::path& file, std::string_view kind, int version) {
  Json json = read_header(file);
  const JsonPlace place{file.string()};
  if (const std::string found = kind_in(json, file); found != kind)
    throw Error("{}: is a model of kind '{}', needed is '{}'", file.string(), found, kind);
  const int written =
      from_json_value<int>(required_key(json, "version", place), place.at("version"), {1, 1e9});
  if (written > version)
    throw Error("{}: is of kind {} and version {}, this gramloom knows versions up to {}",
                file.string(), kind, written, version);
  return json;
}

void check_tensors(const std::map<std::string, TensorData>& tensors,
                   const std::map<std::string, std::vector<std::int64_t>>& shapes,
                   const std::string& file) {
  for (const auto& [name, shape] : shapes) {
    const auto found = tensors.find(name);
    if (found == tensors.end()) throw Error("{}: lacks the tensor '{}'", file, name);
    if (found->second.shape != shape)
      throw Error("{}: tensor '{}' is of shape [{}], its description says [{}]", file, name,
                  fmt::join(found->second.shape, ", "), fmt::join(shape, ", "));
    for (const float value : found->second.values)
      if (!std::isfinite(value))
        throw Error("{}: tensor '{}' holds a value that is not finite", file, name);
  }
  for (const auto& [name, tensor] : tensors)
    if (!shapes.contains(name)) throw Error("{}: tensor '{}' belongs to no such model", file, name);
}

}  // namespace gramloom
