#include "jobs/surface_maps.h"

#include "core/error.h"

namespace gramloom {

void add_surface_maps(Texture& texture, const Config& config, std::vector<std::string>& notes) {
  const std::vector<std::string> asked = maps_asked(config.surface);
  if (asked.empty()) return;
  const auto height = texture.maps.find("height");
  if (height == texture.maps.end()) {
    notes.push_back(fmt::format("no {}: the texture has no map 'height'", fmt::join(asked, ", ")));
    return;
  }
  texture.maps.merge(maps_of_height(one_channel(height->second), config.surface, config.tile));
}

}  // namespace gramloom
