#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// What the results of a run are exported as.
enum class ExportTarget { gltf, materialx };
template <>
inline constexpr auto enum_names<ExportTarget> = std::to_array<std::string_view>({"gltf",
                                                                                  "materialx"});

struct ExportWork {
  std::filesystem::path run;  // the folder of a run
  ExportTarget target = ExportTarget::gltf;
  std::string only;     // as `run --only`: a job's exemplar/method/seedN or the first two
  double strength = 0;  // pixels that a height of 1 stands; 0: as the run's [surface], or 8
  std::filesystem::path output;  // folder
};

struct Exported {
  std::vector<std::filesystem::path> documents;
  std::vector<std::string> notes;  // what is left out, and why
  std::vector<std::string>
      failures;  // "pebbles/quilting/seed1: …": jobs that could not be exported
};

/// Exports each finished job of a run as a material: DIR/<exemplar>/<method>/seed1.gltf or .mtlx,
/// and its pictures beside it. Maps count by their names: height, normal, roughness, metalness,
/// occlusion, and usual other words for these. Throws ConfigError where the folder has no results
/// to export or something would be written over. A job whose files cannot be read or written does
/// not stop the others.
Exported export_run(const ExportWork& work);

}  // namespace gramloom
