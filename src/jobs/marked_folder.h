#pragma once

#include <filesystem>
#include <string>

namespace gramloom {

/// A folder that a command fills, `word` is its name: it is new, empty, or an earlier one's, which
/// has left there the file `mark`. So no file of the user's is replaced, nor one of a run, whose
/// files have the same names.
struct MarkedFolder {
  std::string word;
  std::filesystem::path from;  // the run's folder
  std::filesystem::path folder;
  std::string mark;
};

/// Throws ConfigError where it is none of these: "export out/a: --output out/b has files …".
void check_marked_folder(const MarkedFolder& marked);

}  // namespace gramloom
