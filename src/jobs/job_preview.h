#pragma once

#include <filesystem>
#include <optional>
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

/// Reads them as a preview will. Throws ConfigError for what no preview can use: `check` and `run`
/// say it before the first job.
void check_preview_files(const Config& config);

/// Their hashes.
Named<std::string> preview_hashes(const Config& config, FileHashes& hashes);

/// The config's surroundings, kept from job to job as long as their files stay the same.
struct PreviewEnvironment {
  Named<std::string> hashes;  // of all that the preview reads, when it was read
  std::optional<Image> image;
};

/// What a job made, to be shown.
struct ShownTexture {
  const Method& method;
  Random random;
  const Texture& texture;
  const OutputFormats& formats;
};

/// Renders a job's texture as the config's [preview] says, and writes it as `name`_preview.png in
/// `folder`. Returns the file's name; "" where there is none, and why in the notes: a texture that
/// the preview does not suit is a texture all the same. Surroundings are read when they are not
/// those that are kept.
std::string write_preview(const std::filesystem::path& folder, const std::string& name,
                          const Config& config, const ShownTexture& shown, FileHashes& hashes,
                          PreviewEnvironment& environment, const Control& control,
                          std::vector<std::string>& notes);

}  // namespace gramloom
