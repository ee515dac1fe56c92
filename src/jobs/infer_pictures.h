#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/progress.h"

namespace gramloom {

/// What `infer` is asked: the picture of a pose, or a picture each of several.
struct InferWork {
  FileOrName model;
  std::string pose;              // "30,10,-5"
  std::string to;                // of a sequence that begins with `pose`: its last pose
  int frames = 24;               // of that sequence
  std::filesystem::path poses;   // or a table of poses, with the model's names for columns
  std::filesystem::path output;  // the picture; of several their folder
  std::string format = "exr";    // of files in a folder
  bool extrapolates = false;     // poses outside the trained ranges too
};

/// Writes the pictures as `output`, or as frame_0001.exr … in the folder `output`, a row of a table
/// or a frame of a sequence each, as floats where the file can hold them; else the model's least
/// and largest value become 0 and 1, and a note says so. Throws ConfigError, before anything is
/// written, for a model that cannot be read, poses that are not the model's or outside its ranges,
/// and for an output that is a file of another kind; Error for files, Interrupted.
struct InferredFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;
};
InferredFiles infer_pictures(const InferWork& work, const Control& control);

}  // namespace gramloom
