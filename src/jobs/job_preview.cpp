#include "jobs/job_preview.h"

#include "core/error.h"
#include "jobs/preview_files.h"
#include "jobs/solid_texture.h"
#include "runs/map_names.h"
#include "surface/mesh_file.h"
#include "surface/preview_mapping.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// A texture's frames are slices of the solid that it moves through.
Volume volume_of(const Texture& texture) {
  Volume volume;
  for (const auto& [name, map] : texture.maps)
    if (name.starts_with("frame_")) volume.slices.push_back(linear_picture(map));
  return volume;
}

PreviewMaterial material_of(const Config& config, const ShownTexture& shown) {
  const Texture& texture = shown.texture;
  PreviewMaterial material;
  if (config.preview->mapping == Mapping::solid) {
    material.volume = volume_of(texture);
    const auto* procedural = std::get_if<ProceduralParams>(&shown.method);
    if (material.volume.slices.empty() && procedural)
      material.solid = solid_of(*procedural, shown.random);
    return material;
  }
  const Image colours = extract_channels(texture.image, 0, texture.image.channels < 3 ? 1 : 3);
  material.colour =
      is_coded(shown.formats.picture.encoding.pixel_type) ? linear_picture(colours) : colours;
  material.wraps = config.tile;
  const auto normals = normals_of(shown.formats);
  for (const auto& [name, map] : texture.maps) {
    const auto green = normals.find(name);
    const std::string what = green != normals.end()          ? "normal"
                             : name == config.surface.height ? "height"
                                                             : material_map(name);
    if (what.empty() || material.maps.contains(what)) continue;
    material.maps[what] = what == "normal" ? map : one_channel(map);
    if (green != normals.end()) material.green = green->second;
  }
  return material;
}

}  // namespace

Named<fs::path> preview_files(const Config& config) {
  Named<fs::path> files;
  if (!config.preview) return files;
  const PreviewParams& params = *config.preview;
  for (const fs::path& file : params.environment)
    files.push_back({fmt::format("environment_{}", files.size()), file});
  if (!params.shape.is_name()) files.push_back({"shape", params.shape});
  return files;
}

void check_preview_files(const Config& config) {
  if (preview_files(config).empty()) return;
  const PreviewParams& params = *config.preview;
  try {
    if (!params.shape.is_name()) make_mapping(params, read_mesh(params.shape));
    if (const Image around = read_environment(params); !around.empty())
      latlong_picture(around, params.environment_kind);
  } catch (const Error& error) {
    throw ConfigError("{}: preview: {}", config.file.string(), error.what());
  }
}

Named<std::string> preview_hashes(const Config& config, FileHashes& hashes) {
  Named<std::string> result;
  for (const auto& [key, file] : preview_files(config)) result.push_back({key, hashes.of(file)});
  return result;
}

std::string write_preview(const fs::path& folder, const std::string& name, const Config& config,
                          const ShownTexture& shown, FileHashes& hashes,
                          PreviewEnvironment& environment, const Control& control,
                          std::vector<std::string>& notes) {
  if (!config.preview) return "";
  const PreviewParams& params = *config.preview;
  try {
    const PreviewMaterial material = material_of(config, shown);
    if (auto now = preview_hashes(config, hashes); !environment.image || environment.hashes != now)
      environment = {std::move(now), read_environment(params)};
    const RenderedPreview rendered =
        render_preview(params, {&material, 1}, *environment.image, control);
    const std::string file = name + "_preview.png";
    write_image(folder / file, shown_preview(params, rendered.picture), {});
    for (const std::string& note : rendered.notes)
      notes.push_back(fmt::format("preview: {}", note));
    return file;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    notes.push_back(fmt::format("no preview: {}", error.what()));
    return "";
  }
}

}  // namespace gramloom
