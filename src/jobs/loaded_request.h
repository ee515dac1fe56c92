#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/request.h"
#include "jobs/config.h"
#include "jobs/exemplar.h"
#include "jobs/filling.h"

namespace gramloom {

/// What a job asks for, as the files of its config say it; all but the seed. Exemplars of no weight
/// are left out.
struct LoadedRequest {
  std::vector<Exemplar> exemplars;
  Target target;
  std::vector<ExemplarFile> files;  // of a result: its picture, then its maps by name
  std::vector<std::string> notes;   // where values are not quite those of the files
  Metadata metadata;                // of the picture that is filled
  std::optional<Corner> filled_at;  // where that lies in the texture, if it is the exemplar
};

/// Of this exemplar of the config; of none: for a method without. Throws ConfigError when files
/// don't fit together, and says which; Error for a file that cannot be read.
LoadedRequest load_request(const Config& config, std::optional<std::size_t> exemplar);

/// "configs/a.toml: [fill]", for messages.
std::string place_of(const Config& config, std::string_view section);

}  // namespace gramloom
