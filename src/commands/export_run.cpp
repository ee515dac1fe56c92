#include "commands/export_run.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "io/field_values.h"
#include "io/image_file.h"
#include "io/text_file.h"
#include "jobs/machine.h"
#include "jobs/marked_folder.h"
#include "jobs/pattern.h"
#include "report/preview.h"
#include "runs/job_files.h"
#include "runs/job_maps.h"
#include "runs/run_folder.h"
#include "surface/export/gltf.h"
#include "surface/export/materialx.h"
#include "surface/maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

// A job's pictures by what they are to a material.
struct MaterialFiles {
  std::string name;
  fs::path colour, normal, height, roughness, metalness, occlusion;
  GreenAxis green = GreenAxis::up;
  double strength = 0;
  Tile tile = Tile::none;
};

fs::path* member_of(MaterialFiles& files, const std::string& known) {
  if (known == "normal") return &files.normal;
  if (known == "height") return &files.height;
  if (known == "roughness") return &files.roughness;
  if (known == "metalness") return &files.metalness;
  if (known == "occlusion") return &files.occlusion;
  return nullptr;
}

Json settings_of(const JobRecord& record, const char* key) {
  return record.settings.is_object() ? record.settings.value(key, Json::object()) : Json::object();
}

double strength_of(const JobRecord& record) {
  const Json surface = settings_of(record, "surface");
  return surface.is_object() ? surface.value("strength", MapParams().strength)
                             : MapParams().strength;
}

MaterialFiles files_of(const ExportWork& work, const JobOnDisk& job) {
  MaterialFiles files;
  files.name = job.name;
  files.tile = tile_of(job.record.settings);
  files.strength = work.strength > 0 ? work.strength : strength_of(job.record);
  const fs::path folder = (work.run / job.name).parent_path();
  for (const std::string& file : job.record.files) {
    if (fs::path(file).filename() != file) throw Error("{} is elsewhere", file);
    const std::string map = map_of_file(job.name, file);
    if (file == job.record.files.front()) {
      files.colour = folder / file;
    } else if (fs::path* member = member_of(files, material_map_of(job.record, map));
               member && member->empty()) {
      *member = folder / file;
      if (const auto green = job.record.normals.find(map); green != job.record.normals.end())
        files.green = green->second;
    }
  }
  return files;
}

// --- glTF ---------------------------------------------------------------------------------------

// 8-bit sRGB of three channels, or four with alpha.
Image colours_of(const ImageFile& file) {
  const Image shown = preview(file, white_of(file));
  const bool alpha = shown.channels == 2 || shown.channels == 4;
  Image colours(shown.size(), alpha ? 4 : 3);
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x)
      for (int c = 0; c < colours.channels; ++c)
        colours.at(x, y)[c] =
            shown.at(x, y)[c == 3 ? shown.channels - 1 : std::min(c, shown.channels >= 3 ? 2 : 0)];
  return colours;
}

std::optional<Image> read_map(const fs::path& file, Size size) {
  if (file.empty()) return std::nullopt;
  const Image map = read_image(file).image;
  if (map.size() != size)
    throw Error("{} has {}×{} pixels, its colours {}×{}", file.filename().string(), map.width,
                map.height, size.width, size.height);
  return map;
}

std::optional<Image> read_channel(const fs::path& file, Size size) {
  const auto map = read_map(file, size);
  return map ? std::optional(extract_channels(*map, 0, 1)) : std::nullopt;
}

MaterialSet read_material(const MaterialFiles& files) {
  MaterialSet material;
  material.name = files.name;
  material.colour = colours_of(read_image(files.colour));
  const Size size = material.colour.size();
  if (const auto normals = read_map(files.normal, size))
    material.normal = colours_to_normals(*normals, files.green);
  material.height = read_channel(files.height, size);
  material.roughness = read_channel(files.roughness, size);
  material.metalness = read_channel(files.metalness, size);
  material.occlusion = read_channel(files.occlusion, size);
  material.strength = files.strength;
  material.tile = files.tile;
  return material;
}

// --- MaterialX ----------------------------------------------------------------------------------

bool is_linear(const Encoding& encoding) {
  const std::string& space = encoding.colour_space;
  return space.starts_with("lin") || space.starts_with("Lin") || space == "scene_linear";
}

// The files themselves; but normals point up, and where there are none they are made of the height.
fs::path write_materialx(const fs::path& stem, const MaterialFiles& files) {
  const fs::path folder = stem.parent_path();
  const auto copy = [&](const fs::path& file) -> fs::path {
    if (file.empty()) return {};
    write_text(folder / file.filename(), read_text(file));
    return file.filename();
  };
  const ImageFile colour = read_image(files.colour);
  MaterialXMaps maps{files.name,
                     copy(files.colour),
                     is_linear(colour.encoding),
                     "",
                     copy(files.height),
                     copy(files.roughness),
                     copy(files.metalness),
                     copy(files.occlusion),
                     files.strength / colour.image.width};
  const fs::path normal = stem.filename().string() + "_normal.png";
  const auto write_normals = [&](const Image& normals) {
    write_image(folder / normal, normals_to_colours(normals, GreenAxis::up),
                {PixelType::uint16, "", {}});
    maps.normal = normal;
  };
  if (!files.normal.empty()) {
    const Image picture = read_image(files.normal).image;
    if (files.green == GreenAxis::up && !is_signed(picture))
      maps.normal = copy(files.normal);
    else
      write_normals(colours_to_normals(picture, files.green));
  }
  if (files.normal.empty() && !files.height.empty())
    write_normals(normals_from_height(*read_channel(files.height, colour.image.size()),
                                      files.strength, files.tile));
  fs::path document = stem;
  document += ".mtlx";
  write_text(document, materialx_document(maps));
  return document;
}

// Says of a folder that its pictures and documents are an export's, and may be replaced by another.
constexpr const char* mark = "export.json";

void mark_folder(const ExportWork& work) {
  create_folder(work.output);
  write_text(work.output / mark, fmt::format("{{ \"gramloom\": \"{}\" }}\n", version()));
}

bool is_wanted(const ExportWork& work, const JobOnDisk& job) {
  return work.only.empty() || matches(work.only, job.name) ||
         matches(work.only, fs::path(job.name).parent_path().generic_string());
}

fs::path export_job(const ExportWork& work, const JobOnDisk& job) {
  const fs::path stem = work.output / job.name;
  create_folder(stem.parent_path());
  const MaterialFiles files = files_of(work, job);
  if (work.target == ExportTarget::materialx) return write_materialx(stem, files);
  return write_gltf(stem, read_material(files), "gramloom " + std::string(version())).front();
}

}  // namespace

Exported export_run(const ExportWork& work) {
  const RunOnDisk run = read_named_run(work.run);
  check_marked_folder({"export", work.run, work.output, mark});
  std::vector<const JobOnDisk*> finished;
  std::size_t wanted = 0;
  for (const JobOnDisk& job : run.jobs) {
    if (!is_wanted(work, job)) continue;
    ++wanted;
    if (is_finished(job.record, (work.run / job.name).parent_path())) finished.push_back(&job);
  }
  if (wanted == 0)
    throw ConfigError("export {}: no job matches --only {}", work.run.string(), work.only);
  if (finished.empty())
    throw ConfigError("export {}: none of {} job{} is finished, with its pictures there",
                      work.run.string(), wanted, wanted == 1 ? "" : "s");
  mark_folder(work);
  Exported exported;
  for (const JobOnDisk* job : finished) {
    try {
      exported.documents.push_back(export_job(work, *job));
    } catch (const Error& error) {
      exported.failures.push_back(fmt::format("{}: {}", job->name, error.what()));
    }
  }
  if (finished.size() < wanted)
    exported.notes.push_back(fmt::format("{} of {} jobs left out: they are not finished",
                                         wanted - finished.size(), wanted));
  return exported;
}

}  // namespace gramloom
