#pragma once

#include <map>
#include <string>

#include "io/pictures_in_memory.h"
#include "python/arrays.h"
#include "python/watched_work.h"

namespace gramloom::python {

/// A texture, and its maps by name.
struct Made {
  Stored texture;
  std::map<std::string, Stored> maps;
};

/// Makes the one texture of a config. `pictures`: those that it names and that are no files. Throws
/// ConfigError for what the user must change, Interrupted, and Error when it fails.
Made synthesise(const std::string& config, PicturesInMemory::Pictures pictures, Watch& watch);

}  // namespace gramloom::python
