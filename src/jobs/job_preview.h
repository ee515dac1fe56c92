#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/json_fields.h"
#include "jobs/config.h"
#include "jobs/inputs.h"
#include "jobs/results.h"

namespace gramloom {

/// The files that the config's [preview] reads, by their keys: the surroundings, a mesh.
Named<std::filesystem::path> preview_files(const Config& config);

/// Their hashes.
Named<std::string> preview_hashes(const Config& config, FileHashes& hashes);

/// Renders a job's texture as the config's [preview] says, and writes it as `name`_preview.png in
/// `folder`. Returns the file's name; "" where there is none, and why in the notes: a texture that
/// the preview does not suit is a texture all the same.
std::string write_preview(const std::filesystem::path& folder, const std::string& name,
                          const Config& config, const Method& method, Random random,
                          const Texture& texture, const OutputFormat& format,
                          const Control& control, std::vector<std::string>& notes);

}  // namespace gramloom
