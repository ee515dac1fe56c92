#include "jobs/preview_files.h"

#include <algorithm>

#include "core/error.h"
#include "io/image_encode.h"
#include "jobs/map_file.h"
#include "jobs/names.h"
#include "jobs/protected_files.h"
#include "jobs/solid_texture.h"
#include "runs/map_names.h"
#include "surface/maps.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

// A texture's picture and maps by their files.
struct TextureFiles {
  fs::path picture;
  std::map<std::string, fs::path> maps;
};

// The name that a texture's maps begin with: "wall" of wall.png, and of wall_colour.png, as the
// pictures of a material are called.
std::string texture_name(const fs::path& picture) {
  std::string name = picture.stem().string();
  for (const std::string_view ending : {"_colour"sv, "_color"sv, "_albedo"sv, "_basecolor"sv})
    if (name.size() > ending.size() && name.ends_with(ending))
      return name.substr(0, name.size() - ending.size());
  return name;
}

// The map that a picture is of a texture by their names: "height" of wall.png for wall_height.jpg.
std::string map_name(const fs::path& picture, const fs::path& map) {
  const std::string stem = texture_name(picture) + "_", name = map.stem().string();
  if (!name.starts_with(stem) || picture.parent_path() != map.parent_path()) return "";
  return material_map(name.substr(stem.size()));
}

std::vector<TextureFiles> grouped(const std::vector<std::string>& images) {
  std::vector<TextureFiles> textures;
  for (const std::string& image : images) {
    const fs::path file = image;
    const bool is_map = std::any_of(images.begin(), images.end(), [&](const std::string& other) {
      return !map_name(other, file).empty();
    });
    if (!is_map) textures.push_back({file, {}});
  }
  for (TextureFiles& texture : textures)
    for (const std::string& image : images)
      if (const std::string name = map_name(texture.picture, image); !name.empty())
        texture.maps[name] = image;
  return textures;
}

// Maps that lie beside a picture under its name.
void find_beside(TextureFiles& texture, bool relief, std::vector<std::string>& used) {
  for (const std::string_view name : preview_maps) {
    if (texture.maps.contains(std::string(name))) continue;
    if (name == "normal" && relief && texture.maps.contains("height")) continue;
    const std::string own = texture.picture.extension().string();
    for (const std::string_view extension : {std::string_view(own), ".png"sv, ".exr"sv, ".tif"sv}) {
      fs::path file = texture.picture;
      file.replace_filename(fmt::format("{}_{}{}", texture_name(texture.picture), name, extension));
      std::error_code ignored;
      if (!fs::is_regular_file(file, ignored)) continue;
      texture.maps[std::string(name)] = file;
      used.push_back(fmt::format("{}: {}", name, file.string()));
      break;
    }
  }
}

void read_map(const std::string& name, const fs::path& file, PreviewMaterial& material) {
  try {
    ImageFile map = read_image(file);
    if (name == "normal") material.green = green_of_map(name, {file, {}, {}}, map.metadata);
    material.maps[name] = name == "normal" ? std::move(map.image) : one_channel(map.image, name);
  } catch (const Error& error) {
    const std::string what = error.what();
    throw Error("{}{}", what.starts_with(file.string()) ? "" : file.string() + ": ", what);
  }
}

PreviewMaterial read_files(const TextureFiles& files) {
  PreviewMaterial material;
  if (!files.picture.empty()) material.colour = read_colours(files.picture);
  for (const auto& [name, file] : files.maps) read_map(name, file, material);
  return material;
}

// The picture must not take the place of what it is made from, and it must be one that can be
// written.
void check_output(const PreviewWork& work, const std::vector<TextureFiles>& textures,
                  const fs::path& output) {
  const std::string reader = "the preview is made from";
  std::vector<InputFile> read;
  for (const std::string& image : work.images) read.push_back({image, reader});
  for (const TextureFiles& texture : textures)
    for (const auto& [name, file] : texture.maps) read.push_back({file, reader});
  for (const fs::path& file : work.params.environment) read.push_back({file, reader});
  read.push_back({work.params.shape, reader});
  try {
    const int channels = work.params.background == Background::transparent ? 4 : 3;
    encoded_image(output.extension().string(), Image(1, 1, channels), {});
    check_folder_of(output);
    if (fs::is_directory(output)) throw Error("is a folder");
    ProtectedFiles(read).check(output);
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", output.string(), error.what());
  }
}

bool is_name(const std::string& image) { return FileOrName(image).is_name(); }

// What is given must have an effect.
void check_use(const PreviewWork& work) {
  const bool solid = work.params.mapping == Mapping::solid;
  const bool named = std::any_of(work.images.begin(), work.images.end(), is_name);
  if (work.images.empty() && (solid || work.maps.empty()))
    throw ConfigError("needed is a texture, or a map (--map) of a surface in one colour");
  if (!work.set.empty() && !named)
    throw ConfigError("--set {}: has no effect, {} is no procedural texture but a picture",
                      work.set.front(), work.images.empty() ? "a map" : work.images.front());
  if (work.maps.empty()) return;
  const std::string& map = work.maps.begin()->first;
  if (solid) throw ConfigError("--map {}: has no effect on a solid", map);
  if (!work.images.empty() && is_name(work.images.front()))
    throw ConfigError("--map {}: has no effect on the procedural texture '{}', which has its own",
                      map, work.images.front());
}

bool has_height(const TextureFiles& texture) {
  return is_name(texture.picture.string()) || texture.maps.contains("height");
}

// What is given must have an effect: also a relief, which needs heights, and normals, before which
// a relief goes.
void check_relief(const PreviewParams& params, const std::vector<TextureFiles>& textures) {
  if (!asks_for_relief(params)) return;
  for (const TextureFiles& texture : textures) {
    const auto normal = texture.maps.find("normal");
    if (normal != texture.maps.end() && has_height(texture))
      throw ConfigError(
          "{}: normals have no effect where heights are displaced (--displacement) or bumped "
          "(--bump): leave one of them out",
          normal->second.string());
  }
  if (params.displacement == 0 && !textures.empty() &&
      std::none_of(textures.begin(), textures.end(), has_height))
    throw ConfigError(
        "bump = {}: there is no map 'height' of {}", params.bump,
        textures.front().picture.empty() ? "the surface" : textures.front().picture.string());
}

// In place of what was found.
void add_named_maps(TextureFiles& texture, const NamedFiles<MapFile>& maps) {
  for (const auto& [name, file] : maps) {
    const std::string known = material_map(name);
    texture.maps[known.empty() ? name : known] = file.image;
  }
}

std::vector<PreviewMaterial> read_materials(const PreviewWork& work,
                                            const std::vector<TextureFiles>& textures) {
  std::vector<PreviewMaterial> materials;
  if (textures.empty()) {
    materials.emplace_back();
    for (const std::string& slice : work.images)
      materials.front().volume.slices.push_back(read_colours(slice));
  }
  const bool solid = work.params.mapping == Mapping::solid;
  for (const TextureFiles& texture : textures)
    materials.push_back(
        is_name(texture.picture.string())
            ? procedural_material(texture.picture.string(), work.set, solid, work.params.size)
            : read_files(texture));
  return materials;
}

Image render(const PreviewWork& work, const fs::path& output, std::vector<std::string>& used,
             const Control& control) {
  check_preview(work.params);
  check_use(work);
  std::vector<TextureFiles> textures;  // none of a stack of slices
  if (work.params.mapping != Mapping::solid ||
      std::all_of(work.images.begin(), work.images.end(), is_name))
    textures = grouped(work.images);
  if (work.images.empty()) textures.emplace_back();  // of one colour
  if (!textures.empty()) add_named_maps(textures.front(), work.maps);
  for (TextureFiles& texture : textures)
    if (!texture.picture.empty() && !is_name(texture.picture.string()))
      find_beside(texture, asks_for_relief(work.params), used);
  check_relief(work.params, textures);
  check_output(work, textures, output);
  RenderedPreview rendered = render_preview(work.params, read_materials(work, textures),
                                            read_environment(work.params), control);
  used.insert(used.end(), rendered.notes.begin(), rendered.notes.end());
  return std::move(rendered.picture);
}

}  // namespace

Image read_colours(const fs::path& file) {
  const ImageFile read = read_image(file);
  return is_coded(read.encoding.pixel_type) ? linear_picture(read.image) : read.image;
}

Image read_environment(const PreviewParams& params) {
  if (params.environment.empty()) return {};
  if (params.environment.size() == 1) return read_colours(params.environment.front());
  std::vector<Image> faces;
  for (const fs::path& file : params.environment) faces.push_back(read_colours(file));
  return sky_box_strip(faces);
}

std::map<std::string, fs::path> texture_files(const FileOrName& texture,
                                              const PreviewParams& params) {
  if (texture.empty() || texture.is_name()) return {};
  TextureFiles files{texture, {}};
  std::vector<std::string> found;
  find_beside(files, asks_for_relief(params), found);
  files.maps.emplace("", texture);
  return std::move(files.maps);
}

PreviewMaterial read_texture(const FileOrName& texture, const PreviewParams& params) {
  if (texture.is_name())
    return procedural_material(texture.string(), {}, params.mapping == Mapping::solid, params.size);
  TextureFiles files{texture, texture_files(texture, params)};
  files.maps.erase("");
  return read_files(files);
}

PreviewFile make_preview(const PreviewWork& work, const fs::path& output, const Control& control) {
  PreviewFile result;
  Image rendered;
  try {
    rendered = render(work, output, result.used, control);
  } catch (const Interrupted&) {
    throw;
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
  const Shown as =
      in_small_letters(output.extension().string()) == ".exr" ? Shown::light : Shown::colours;
  write_image(output, shown_preview(work.params, rendered, as), {});
  return result;
}

}  // namespace gramloom
