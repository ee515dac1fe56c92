#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/fields.h"

namespace gramloom {

/// The folder of shipped networks: named by GRAMLOOM_MODELS, share/gramloom/models beside lib/
/// where the libraries are installed, or that of the sources.
std::filesystem::path models_folder();

/// The files there with this extension (".toml", ".safetensors"), by name.
std::vector<std::filesystem::path> models_in_folder(std::string_view extension);

/// The file for `model`: itself when it is a path, or NAME with this extension in that folder when
/// it is a bare word. Throws ConfigError "unknown WHAT 'NAME'" when there is none, with those that
/// there are.
std::filesystem::path find_model(const FileOrName& model, std::string_view extension,
                                 std::string_view what);

}  // namespace gramloom
