#include "jobs/marked_folder.h"

#include "core/error.h"

namespace gramloom {

namespace fs = std::filesystem;

void check_marked_folder(const MarkedFolder& marked) {
  const std::string where =
      fmt::format("{} {}: --output {}", marked.word, marked.from.string(), marked.folder.string());
  std::error_code ignored;
  if (fs::equivalent(marked.from, marked.folder, ignored))
    throw ConfigError("{} is the run's own folder; choose another", where);
  if (!fs::exists(marked.folder, ignored)) return;
  if (!fs::is_directory(marked.folder, ignored)) throw ConfigError("{} is no folder", where);
  if (!fs::is_empty(marked.folder, ignored) && !fs::exists(marked.folder / marked.mark, ignored))
    throw ConfigError("{} has files that no {} made; choose a new or an empty folder", where,
                      marked.word);
}

}  // namespace gramloom
