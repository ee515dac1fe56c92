#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "jobs/baseline.h"
#include "jobs/config.h"

namespace gramloom {

/// A file that a run reads, and so never writes over.
struct InputFile {
  std::filesystem::path file;
  std::string reader;  // "the config reads": says which, after the file's name
};

/// What a config names, and itself: pictures, maps, weights, network descriptions, start pictures.
std::vector<InputFile> input_files(const Config& config);

/// What a comparison with an earlier run reads.
std::vector<InputFile> input_files(const Baseline& baseline);

}  // namespace gramloom
