#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/fields.h"
#include "core/progress.h"
#include "learnt/inference_model.h"

namespace gramloom {

/// What `infer` is asked: the picture of a pose, or a picture each of several.
struct InferWork {
  FileOrName model;
  std::string pose;              // "30,10,-5"
  std::string to;                // of a sequence that begins with `pose`: its last pose
  int frames = 24;               // of that sequence
  std::filesystem::path poses;   // or a table of poses, with the model's names for columns
  std::filesystem::path output;  // the picture; of several their folder
  std::string format;            // of files in a folder; "": exr
  bool extrapolates = false;     // poses outside the trained ranges too
};

struct InferredFiles {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notes;
};

/// Writes the pictures of the poses into a file each, as floats where these can hold them; else the
/// model's least and largest value become 0 and 1, and a note says so. The poses are the model's.
/// Throws Error for files, Interrupted.
InferredFiles write_inferred(const InferenceModel& model,
                             const std::vector<std::vector<double>>& poses,
                             const std::vector<std::filesystem::path>& files,
                             const Control& control);

/// Writes the pictures as `output`, or as frame_0001.exr … in the folder `output`, a row of a table
/// or a frame of a sequence each; frames that a longer sequence has left there are removed. Throws
/// ConfigError, before anything is written, for a model that cannot be read, poses that are not the
/// model's or outside its ranges, and for an output that is a file of another kind; Error for
/// files, Interrupted.
InferredFiles infer_pictures(const InferWork& work, const Control& control);

}  // namespace gramloom
