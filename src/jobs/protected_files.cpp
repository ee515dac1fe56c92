#include "jobs/protected_files.h"

#include "core/error.h"
#include "io/image_file.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

bool has_mark(const fs::path& picture, const std::string& mark) {
  try {
    std::error_code ignored;
    return fs::is_regular_file(picture, ignored) && read_image(picture).metadata.contains(mark);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

void check_folder_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  if (std::error_code ignored; !folder.empty() && !fs::is_directory(folder, ignored))
    throw Error("there is no folder {}", folder.string());
}

ProtectedFiles::ProtectedFiles(const std::vector<InputFile>& inputs) {
  for (const InputFile& input : inputs)
    if (const auto identity = identity_of(input.file)) inputs_.emplace(*identity, input);
}

std::optional<ProtectedFiles::Identity> ProtectedFiles::identity_of(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

void ProtectedFiles::check(const fs::path& file) const {
  const auto identity = identity_of(file);
  const auto found = identity ? inputs_.find(*identity) : inputs_.end();
  if (found == inputs_.end()) return;
  const InputFile& input = found->second;
  const std::string name = file.lexically_normal().string();
  std::error_code ignored;
  const bool same_name = fs::absolute(file, ignored).lexically_normal() ==
                         fs::absolute(input.file, ignored).lexically_normal();
  if (same_name) throw Error("would write over {}, which {}", name, input.reader);
  throw Error("would write over {}, the same file as {}, which {}", name, input.file.string(),
              input.reader);
}

void check_replaced(const fs::path& file, const ProtectedFiles& inputs, const std::string& mark) {
  if (!is_there(file)) return;
  inputs.check(file);
  if (!has_mark(file, mark))
    throw Error("would replace {}, which this command did not make",
                file.lexically_normal().string());
}

std::filesystem::path file_of_map(const std::filesystem::path& picture, const std::string& map) {
  if (map.empty()) return picture;
  std::filesystem::path file = picture;
  file.replace_filename(
      fmt::format("{}_{}{}", picture.stem().string(), map, picture.extension().string()));
  return file;
}

}  // namespace gramloom
