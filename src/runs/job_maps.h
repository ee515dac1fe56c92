#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"
#include "io/json_text.h"
#include "runs/record.h"

namespace gramloom {

/// The map that a job's file is of its texture: "height" of "seed1_height.png" and the job
/// "exemplar/method/seed1"; "" for the texture itself.
std::string map_of_file(const std::string& job, const std::string& file);
/// What a reader is told that a file of the job is: its map, or "picture".
std::string label_of_file(const std::string& job, const std::filesystem::path& file);

/// What a job's map is to a material: normal or height where the record knows it as such, else what
/// its name says (runs/map_names.h); "" for none of a material's.
std::string material_map_of(const JobRecord& record, const std::string& map);

/// The edges of a job's texture that meet, by its settings; none where they do not say.
Tile tile_of(const Json& settings);

}  // namespace gramloom
