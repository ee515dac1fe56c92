#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/json_fields.h"
#include "jobs/config.h"

namespace gramloom {

/// The hash of a file's bytes (core/hash.h). Throws Error when the file cannot be read.
std::string file_hash(const std::filesystem::path& path);

/// Hashes of files that may change at any time. A file is read again only when the file system says
/// that it is another one, or was written since.
class FileHashes {
 public:
  /// "" for what is no file or cannot be read.
  std::string of(const std::filesystem::path& path);

 private:
  struct Known {
    struct stat state;
    std::string hash;
  };
  std::map<std::filesystem::path, Known> known_;
};

/// The files of one picture of an exemplar: "image", its maps as "maps.NAME", "mask" and "guide".
Named<std::filesystem::path> files_of(const ExemplarPicture& picture);
/// The files of [guide], [mix], [turn] and [fill], by section and key: "fill.image".
Named<std::filesystem::path> files_of(const Direction& direction);

/// The hashes of the files of all of an exemplar's pictures, in their order.
std::vector<std::string> exemplar_hashes(const ExemplarEntry& exemplar, FileHashes& hashes);
Named<std::string> direction_hashes(const Direction& direction, FileHashes& hashes);

/// The hashes of the files that a method reads: those that its parameters name, and the "network"
/// that is meant by a name.
Named<std::string> method_hashes(const Method& method, FileHashes& hashes);

}  // namespace gramloom
