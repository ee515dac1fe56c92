#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/json_fields.h"
#include "io/safetensors.h"

namespace gramloom {

// The files of trained models: tensors in a .safetensors file, and in its metadata, under
// "gramloom", the model's description as JSON, with its version and kind first.

/// The metadata of a model's file.
template <class Description>
std::map<std::string, std::string> described(const Description& description) {
  Json json{{"version", Description::version}};
  json.update(to_json_value(description));
  return {{"gramloom", to_text(json)}};
}

/// The JSON of a model's description. Throws Error with the path for a file that holds no model of
/// ours, one of another kind, or one of a version above `version`.
Json read_description_json(const std::filesystem::path& file, std::string_view kind, int version);

/// The kind of a model's file: "generator", "inference". Throws Error likewise.
std::string model_kind(const std::filesystem::path& file);

template <class Description>
Description read_description(const std::filesystem::path& file, std::string_view kind) {
  return from_json_value<Description>(read_description_json(file, kind, Description::version),
                                      {file.string(), "", true});
}

/// Throws Error for a tensor that is missing, one too many, of another shape, or with a value that
/// is not finite.
void check_tensors(const std::map<std::string, TensorData>& tensors,
                   const std::map<std::string, std::vector<std::int64_t>>& shapes,
                   const std::string& file);

}  // namespace gramloom
