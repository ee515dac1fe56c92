#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gramloom {

/// What `pick` is asked: results of a run that are to be in a folder of their own.
struct PickWork {
  std::filesystem::path run;       // the folder of a run
  std::vector<std::string> names;  // of jobs: "pebbles/quilting/seed1"
  std::filesystem::path list;      // a text with more of them, a line each; "": none
  std::filesystem::path output;
};

/// Copies the pictures of these jobs, with their maps, to `output`/<exemplar>/<method>/seed1.png …,
/// each with a config, seed1.toml, that makes it again; returns the textures. `output` is new,
/// empty, or has earlier picks, of which only those stay that are picked again.
/// Throws ConfigError, before anything is written, for a folder that is none of a run, a name that
/// it does not know, a job that is not finished or whose config or files have changed since, and
/// for an `output` with files of another kind.
std::vector<std::filesystem::path> pick_results(const PickWork& work);

}  // namespace gramloom
