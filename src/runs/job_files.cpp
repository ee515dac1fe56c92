#include "runs/job_files.h"

#include <algorithm>

#include "core/error.h"

namespace gramloom {

namespace fs = std::filesystem;

namespace {

// "seed1.png" and "seed1_height.png" are of "seed1", "seed10.png" is not.
bool is_of_stem(const std::string& name, const std::string& stem) {
  return name.starts_with(stem + ".") || name.starts_with(stem + "_");
}

}  // namespace

JobFiles job_files(const fs::path& output, const std::string& job) {
  const fs::path stem = output / job;
  return {stem.parent_path(),
          stem.filename().string(),
          stem.string() + ".json",
          stem.string() + ".csv",
          stem.string() + ".copy_map.png",
          stem.string() + ".checkpoint",
          stem.string() + ".checkpoint.csv",
          stem.string() + ".lock"};
}

fs::path diversity_file(const fs::path& output, const std::string& exemplar,
                        const std::string& method) {
  return output / exemplar / method / "diversity.json";
}

std::string kept_exemplar(const fs::path& output, const std::string& exemplar,
                          const std::string& map) {
  std::error_code ignored;
  for (const auto* extension : {".png", ".exr", ".tif"})
    if (const std::string file =
            fmt::format("{}/exemplar{}{}{}", exemplar, map.empty() ? "" : "_", map, extension);
        fs::is_regular_file(output / file, ignored))
      return file;
  return "";
}

std::string kept_stem(std::size_t picture) {
  return picture == 0 ? "exemplar" : fmt::format("exemplar_picture{}", picture + 1);
}

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw Error("cannot make the folder {}: {}", folder.string(), error.message());
}

void remove_file(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

void remove_unfinished_state(const JobFiles& files) {
  remove_file(files.checkpoint);
  remove_file(files.checkpoint_trace);
}

void remove_stale_temporaries(const JobFiles& files) {
  remove_stale_temporaries(files.folder, files.name);
}

void remove_stale_temporaries(const fs::path& folder, const std::string& stem) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.ends_with(".tmp") && is_of_stem(name.substr(1), stem))
      remove_file(entry.path());
  }
}

void remove_stale_views(const fs::path& folder) {
  std::error_code ignored;
  fs::recursive_directory_iterator at(folder / "page", ignored), end;
  for (; !ignored && at != end; at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with('.') && name.ends_with(".tmp") && at->is_regular_file(ignored))
      remove_file(at->path());
  }
}

void remove_replaced(const JobFiles& files, const std::vector<std::string>& before,
                     const std::vector<std::string>& now) {
  for (const auto& name : before) {
    // The record is a text that anyone may have changed: only files beside it are ours.
    const bool beside = fs::path(name).filename() == name && is_of_stem(name, files.name);
    if (beside && std::find(now.begin(), now.end(), name) == now.end())
      remove_file(files.folder / name);
  }
}

}  // namespace gramloom
