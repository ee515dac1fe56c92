#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/cost.h"
#include "core/progress.h"
#include "io/json_fields.h"
#include "jobs/config.h"
#include "jobs/inputs.h"
#include "jobs/results.h"

namespace gramloom {

/// The files that a preview reads, by their keys: the surroundings, a mesh, a second material.
Named<std::filesystem::path> preview_files(const PreviewEntry& preview);

/// Reads the files of all previews as those will. Throws ConfigError for what no preview can use,
/// and for one that is made of no job: `check`, `run` and `train` say it before the first job.
void check_previews(const Config& config);

/// What a preview of a result of this size takes, with reading its second material.
Cost estimate_entry(const PreviewEntry& preview, Size result);

/// The hashes of its files.
Named<std::string> preview_hashes(const PreviewEntry& preview, FileHashes& hashes);

/// Surroundings by the hashes of their files, kept from job to job.
using PreviewEnvironments = std::map<Named<std::string>, Image>;

/// What a job made, to be shown.
struct ShownTexture {
  const Method& method;
  Random random;
  const Texture& texture;
  const OutputFormats& formats;
};

/// Renders a job's texture as each of these previews of the config says, and writes them as
/// `name`_preview.png in `folder`, or `name`_preview_NAME.png, with this metadata. Returns the
/// files' names; where one is missing, the notes say why: a texture that a preview does not suit is
/// a texture all the same. Throws Error for a file that cannot be written.
std::vector<std::string> write_previews(const std::filesystem::path& folder,
                                        const std::string& name, const Config& config,
                                        const std::vector<const PreviewEntry*>& previews,
                                        const Metadata& metadata, const ShownTexture& shown,
                                        FileHashes& hashes, PreviewEnvironments& environments,
                                        const Control& control, std::vector<std::string>& notes);

}  // namespace gramloom
