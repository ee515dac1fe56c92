#pragma once

#include <map>
#include <string>
#include <vector>

#include "python/arrays.h"
#include "python/watched_work.h"

namespace gramloom::python {

/// A texture, and its maps by name.
struct Made {
  Stored texture;
  std::map<std::string, Stored> maps;
};

/// A picture with the maps of its surface.
struct Material {
  Picture picture;
  std::map<std::string, Picture> maps;
};

/// Makes one texture as a job of a config does. `config`: its keys, with one [method].
/// `exemplars`: pictures of one material; none for a method of formulas. Throws ConfigError for
/// what the user must change, Interrupted, and Error when it fails.
Made synthesise(const std::string& config, const std::vector<Material>& exemplars, Watch& watch);

}  // namespace gramloom::python
