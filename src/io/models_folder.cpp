#include "io/models_folder.h"

#include <algorithm>
#include <cstdlib>

#include "core/modules.h"
#include "io/source_models_folder.h"

namespace gramloom {

namespace fs = std::filesystem;

fs::path models_folder() {
  if (const char* named = std::getenv("GRAMLOOM_MODELS")) return named;
  std::error_code error;
  // Seen from the libraries, as the program may be Python's.
  const fs::path prefix = libraries_folder().parent_path().parent_path();
  const fs::path installed = prefix / "share/gramloom/models";
  return fs::is_directory(installed, error) ? installed : fs::path(source_models_folder);
}

std::vector<fs::path> models_in_folder(std::string_view extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(models_folder(), error))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

fs::path find_model(const FileOrName& model, std::string_view extension, std::string_view what) {
  if (!model.is_name()) return model;
  std::vector<std::string> names;
  for (const auto& file : models_in_folder(extension)) {
    if (file.stem() == model) return file;
    names.push_back(file.stem().string());
  }
  throw ConfigError("unknown {} '{}' (in {} are {})", what, model.string(),
                    models_folder().string(), fmt::join(names, ", "));
}

}  // namespace gramloom
