#pragma once

#include <functional>
#include <optional>
#include <string>

#include "jobs/results.h"
#include "jobs/runner.h"
#include "neural/shared_synthesis.h"

namespace gramloom {

// Each texture of a run by several processes together (neural/shared_synthesis.h), which were
// started with the same command line but for which of them they are. Process 1 does the run, and
// says which job is next; the others make their rows of its texture.

/// What `run` was told of it. "2/4" is the second of four; "": Slurm says so, or nobody.
struct OneJobOptions {
  std::string process;
  std::string meeting;
  int patience = 1800;  // seconds
};

/// Which process this is, and where it meets the others: as told, or in a step of Slurm (srun),
/// as that says, by a file in the folder `output`. Throws ConfigError.
neural::GroupPlace group_place(const OneJobOptions& asked, const std::filesystem::path& output);

/// Throws ConfigError for what several processes cannot do together.
void check_together(const Config& config, const std::string& only, int processes);

/// How much a job needs in each of the processes.
void estimate_together(const Config& config, Plan& plan, int processes);

/// Does the work of all processes but the first, until that has no more; false: until one of them
/// was told to stop. Throws neural::GroupLost when it, or another one, is gone.
bool work_for_first(const Config& config, const RunOptions& options);

// Of process 1:

/// Tells the others which job of the plan is next; nothing: no more.
void say_next(const neural::Group& group, std::optional<int> job);
/// Writes the texture of which each process has its own rows, `own` those of this one, row by row.
WrittenTexture write_together(const neural::Group& group, const Image& own, const Config& config,
                              const std::vector<ExemplarFile>& files,
                              const std::filesystem::path& folder, const std::string& name,
                              const OutputFormats& formats, const Json& settings,
                              const Metadata& picture);

// Of all:

/// Throws Error when one of them says that it cannot begin, or they are to make different textures,
/// as `identity` tells.
void begin_together(const neural::Group& group, const std::string& identity);
void say_unready(const neural::Group& group);
/// The own rows of the texture, and whether any of them was told to stop.
struct OwnRows {
  Image image;
  bool stopped = false;
};
OwnRows make_together(const neural::Group& group, const Method& method, const Request& request,
                      const Control& control, const std::function<bool()>& stopped);

}  // namespace gramloom
