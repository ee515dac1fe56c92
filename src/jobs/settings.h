#pragma once

#include <filesystem>
#include <string>

#include "io/json_text.h"
#include "jobs/inputs.h"
#include "jobs/plan.h"

namespace gramloom {

/// A method's kind and every parameter, defaults included; paths relative to `folder`.
Json method_to_json(const Method& method, const std::filesystem::path& folder);

/// What the files that a job reads hold.
struct InputHashes {
  std::vector<std::string> exemplar;   // of its pictures, in the order of files_of()
  Named<std::string> direction;        // of [fill] and its like, by section and key
  Named<std::string> method;           // by the names of the parameters
  Named<Named<std::string>> previews;  // of each preview of the job, by its name

  friend bool operator==(const InputHashes&, const InputHashes&) = default;
};

/// Whether [surface] makes maps of the job's texture: of a height among its exemplar's maps, which
/// may be guessed, or of a procedural texture.
bool makes_maps(const Config& config, const Job& job);

/// The hashes of what the job's previews read, by their names.
Named<Named<std::string>> preview_hashes(const Config& config, const Job& job, FileHashes& hashes);

InputHashes input_hashes(const Config& config, const Job& job, FileHashes& hashes);

/// Everything that a job's result depends on, and nothing else: two jobs with equal settings have
/// equal results. Files count by their content.
Json job_settings(const Config& config, const Job& job, const InputHashes& inputs);

/// The whole config with every default, for run.json.
Json config_to_json(const Config& config);

}  // namespace gramloom
