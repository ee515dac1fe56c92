#pragma once

#include <filesystem>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// What a trained generator is exported as.
enum class ModelTarget { c, glsl, onnx };
template <>
inline constexpr auto enum_names<ModelTarget> = std::to_array<std::string_view>({"c", "glsl",
                                                                                 "onnx"});

struct ModelExport {
  FileOrName model;  // a file, or the name of one in gramloom's models folder
  ModelTarget target = ModelTarget::c;
  std::vector<double> weights;  // of its materials; none: the first alone
  std::filesystem::path output;
};

/// Writes a trained generator as a file that other programs use without gramloom. Throws
/// ConfigError for a model that cannot be read, is no generator, or does not fit the target or the
/// weights; Error where the file cannot be written.
void export_model(const ModelExport& work);

}  // namespace gramloom
