#include "jobs/surface_maps.h"

#include "core/error.h"

namespace gramloom {

void add_surface_maps(Texture& texture, const Config& config, std::vector<std::string>& notes) {
  const std::vector<std::string> asked = maps_asked(config.surface);
  if (asked.empty()) return;
  const std::string height = height_among(texture.maps, config.surface);
  if (height.empty()) {
    notes.push_back(fmt::format("no {}: the texture has no map '{}'", fmt::join(asked, ", "),
                                config.surface.height));
    return;
  }
  texture.maps.merge(
      maps_of_height(one_channel(texture.maps.at(height)), config.surface, config.tile));
}

}  // namespace gramloom
