#include "jobs/surface_maps.h"

#include "core/error.h"
#include "surface/photo.h"

namespace gramloom {

namespace {

void guess_height(Texture& texture, Tile wraps, std::vector<std::string>& notes) {
  const PhotoParams usual;
  Image height = height_guess(texture.image, usual.height_scale, usual.height_detail,
                              usual.bright_is_deep, wraps);
  texture.maps.emplace("roughness",
                       roughness_guess(height, usual.roughness, usual.roughness_contrast));
  texture.maps["height"] = std::move(height);
  notes.emplace_back("height: guessed from the colours");
}

}  // namespace

void add_surface_maps(Texture& texture, const Config& config, const Job& job,
                      std::vector<std::string>& notes) {
  if (!makes_any(config.surface)) return;
  if (config.surface.guess && job.exemplar && height_among(texture.maps, config.surface).empty())
    guess_height(texture, config.tile, notes);
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
