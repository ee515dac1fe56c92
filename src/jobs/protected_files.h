#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/input_files.h"

namespace gramloom {

/// Whether a file, or a link that may lead nowhere, has this name.
bool is_there(const std::filesystem::path& file);

/// Throws Error when the folder that `file` is to be written into is not there.
void check_folder_of(const std::filesystem::path& file);

/// Files that are read, each known by itself, whatever its names.
class ProtectedFiles {
 public:
  explicit ProtectedFiles(const std::vector<InputFile>& inputs);

  /// Throws Error when `file` is one of them: "would write over …, which …".
  void check(const std::filesystem::path& file) const;

 private:
  using Identity = std::pair<dev_t, ino_t>;
  static std::optional<Identity> identity_of(const std::filesystem::path& file);

  std::map<Identity, InputFile> inputs_;
};

/// Throws Error when writing `file` would write over one of `inputs`, or replace a picture that the
/// same command did not make: one whose metadata lacks `mark`.
void check_replaced(const std::filesystem::path& file, const ProtectedFiles& inputs,
                    const std::string& mark);

/// The file of a map that is written beside a picture: NAME_<map> with the picture's extension; of
/// no map, the picture itself.
std::filesystem::path file_of_map(const std::filesystem::path& picture, const std::string& map);

}  // namespace gramloom
