#include "jobs/job_preview.h"

#include <algorithm>

#include "core/error.h"
#include "jobs/plan.h"
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

PreviewMaterial solid_material(const ShownTexture& shown) {
  PreviewMaterial material;
  material.volume = volume_of(shown.texture);
  const auto* procedural = std::get_if<ProceduralParams>(&shown.method);
  if (material.volume.slices.empty() && procedural)
    material.solid = solid_of(*procedural, shown.random);
  return material;
}

PreviewMaterial flat_material(const Config& config, const ShownTexture& shown) {
  const Texture& texture = shown.texture;
  PreviewMaterial material;
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
    material.maps[what] = what == "normal" ? map : one_channel(map, what);
    if (green != normals.end()) material.green = green->second;
  }
  return material;
}

// Surroundings are the same for all previews that read the same files.
const Image& environment_of(const PreviewEntry& preview, FileHashes& hashes,
                            PreviewEnvironments& environments) {
  Named<std::string> key;
  for (const fs::path& file : preview.environment) key.push_back({"", hashes.of(file)});
  const auto kept = environments.find(key);
  if (kept != environments.end()) return kept->second;
  return environments.emplace(std::move(key), read_environment(preview)).first->second;
}

RenderedPreview render(const PreviewEntry& preview, PreviewMaterial result,
                       const Image& environment, const Control& control) {
  std::vector<PreviewMaterial> materials;
  materials.push_back(std::move(result));
  if (!preview.second.empty()) materials.push_back(read_texture(preview.second, preview));
  return render_preview(preview, materials, environment, control);
}

void check_preview_of_config(const PreviewEntry& preview) {
  if (!preview.shape.is_name()) make_mapping(preview, read_mesh(preview.shape));
  if (const Image around = read_environment(preview); !around.empty())
    latlong_picture(around, preview.environment_kind);
  if (preview.second.empty()) return;
  PreviewParams small = preview;
  small.size = {1, 1};
  check_material(read_texture(preview.second, small));
}

}  // namespace

Named<fs::path> preview_files(const PreviewEntry& preview) {
  Named<fs::path> files;
  for (const fs::path& file : preview.environment)
    files.push_back({fmt::format("environment_{}", files.size()), file});
  if (!preview.shape.is_name()) files.push_back({"shape", preview.shape});
  for (const auto& [map, file] : texture_files(preview.second, preview))
    files.push_back({map.empty() ? "second" : "second_" + map, file});
  return files;
}

void check_previews(const Config& config) {
  if (config.previews.empty()) return;
  const Plan plan = list_jobs(config);
  for (const PreviewEntry& preview : config.previews) {
    const bool used = std::ranges::any_of(plan.jobs, [&](const PlannedJob& planned) {
      return job_matches(preview.only, planned.name);
    });
    if (!used && config.models.empty())  // what is trained makes more of them
      throw ConfigError("{}: {}: only = '{}' matches no job; there are {}{}", preview.place,
                        title_of(preview), preview.only, plan.jobs.front().name,
                        plan.jobs.size() > 1 ? ", …" : "");
    try {
      check_preview_of_config(preview);
    } catch (const Error& error) {
      throw ConfigError("{}: {}: {}", preview.place, title_of(preview), error.what());
    }
  }
}

Cost estimate_entry(const PreviewEntry& preview, Size result) {
  const PreviewParams& params = preview;
  Cost cost = estimate_preview(params, result);
  if (preview.second.empty() || preview.mapping == Mapping::solid) return cost;
  Size size{1024, 1024};  // of a procedural texture
  if (!preview.second.is_name()) try {
      size = read_image_size(preview.second);
    } catch (const Error&) {
      return cost;  // check_previews() says it
    }
  const double pixels = 1.0 * size.width * size.height;
  cost.bytes += 62 * pixels;
  cost.work.serial += 1.8e-7 * pixels;
  return cost;
}

Named<std::string> preview_hashes(const PreviewEntry& preview, FileHashes& hashes) {
  Named<std::string> result;
  for (const auto& [key, file] : preview_files(preview)) result.push_back({key, hashes.of(file)});
  return result;
}

std::vector<std::string> write_previews(const fs::path& folder, const std::string& name,
                                        const Config& config,
                                        const std::vector<const PreviewEntry*>& previews,
                                        const Metadata& metadata, const ShownTexture& shown,
                                        FileHashes& hashes, PreviewEnvironments& environments,
                                        const Control& control, std::vector<std::string>& notes) {
  std::vector<std::string> files;
  for (const PreviewEntry* preview : previews) {
    RenderedPreview rendered;
    try {
      const bool solid = preview->mapping == Mapping::solid;
      rendered = render(*preview, solid ? solid_material(shown) : flat_material(config, shown),
                        environment_of(*preview, hashes, environments), control);
    } catch (const Interrupted&) {
      throw;
    } catch (const Error& error) {
      notes.push_back(fmt::format("no {}: {}", title_of(*preview), error.what()));
      continue;
    }
    files.push_back(fmt::format("{}_{}.png", name, label_of(*preview)));
    write_image(folder / files.back(), shown_preview(*preview, rendered.picture), {}, metadata);
    for (const std::string& note : rendered.notes)
      notes.push_back(fmt::format("{}: {}", title_of(*preview), note));
  }
  return files;
}

}  // namespace gramloom
