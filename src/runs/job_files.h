#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gramloom {

/// Where a job's files are.
struct JobFiles {
  std::filesystem::path folder;
  std::string name;                        // "seed1": what its files begin with
  std::filesystem::path record;            // seed1.json
  std::filesystem::path trace;             // seed1.csv
  std::filesystem::path copy_map;          // seed1.copy_map.png
  std::filesystem::path checkpoint;        // seed1.checkpoint
  std::filesystem::path checkpoint_trace;  // seed1.checkpoint.csv
  std::filesystem::path lock;              // seed1.lock, while a process does the job
};

/// The files of the job called "exemplar/method/seed1" in the folder `output`.
JobFiles job_files(const std::filesystem::path& output, const std::string& job);

/// Where the diversity of the seeds of an exemplar and a method is kept, in the folder `output`.
std::filesystem::path diversity_file(const std::filesystem::path& output,
                                     const std::string& exemplar, const std::string& method);

/// An exemplar's picture as the methods saw it, or one of its maps: the run in the folder `output`
/// keeps it as "pebbles/exemplar.png" or "pebbles/exemplar_height.png", or in another format. From
/// that folder on; "" where there is none.
std::string kept_exemplar(const std::filesystem::path& output, const std::string& exemplar,
                          const std::string& map = "");

/// What the files of an exemplar's picture begin with, counted from 0: "exemplar",
/// "exemplar_picture2", ….
std::string kept_stem(std::size_t picture);

/// Makes a folder and those above it. Throws Error.
void create_folder(const std::filesystem::path& folder);

/// Removes a file if it is there and can be removed.
void remove_file(const std::filesystem::path& file);

/// Removes what an unfinished job keeps to go on from.
void remove_unfinished_state(const JobFiles& files);

/// Removes half-written temporary files that a killed process left of a job, or of the files in
/// `folder` that begin with "stem." or "stem_".
void remove_stale_temporaries(const JobFiles& files);
void remove_stale_temporaries(const std::filesystem::path& folder, const std::string& stem);
/// Likewise of all that a page shows, in `folder`/page. Nobody else may be writing it.
void remove_stale_views(const std::filesystem::path& folder);

/// Removes pictures of the result before that the new one has not written over.
void remove_replaced(const JobFiles& files, const std::vector<std::string>& before,
                     const std::vector<std::string>& now);

}  // namespace gramloom
