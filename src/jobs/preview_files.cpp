#include "jobs/preview_files.h"

#include <algorithm>

#include "core/error.h"
#include "io/image_file.h"
#include "jobs/protected_files.h"
#include "jobs/solid_texture.h"
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
  const std::string word = name.substr(stem.size());
  const bool known =
      std::find(preview_maps.begin(), preview_maps.end(), word) != preview_maps.end();
  return known ? word : "";
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
void find_beside(TextureFiles& texture, std::vector<std::string>& used) {
  for (const std::string_view name : preview_maps) {
    if (texture.maps.contains(std::string(name))) continue;
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

Image read_map(const std::string& name, const fs::path& file) {
  try {
    Image map = read_image(file).image;
    return name == "normal" ? map : one_channel(map);
  } catch (const Error& error) {
    const std::string what = error.what();
    throw Error("{}{}", what.starts_with(file.string()) ? "" : file.string() + ": ", what);
  }
}

PreviewMaterial read_texture(const TextureFiles& files) {
  PreviewMaterial material;
  material.colour = read_colours(files.picture);
  for (const auto& [name, file] : files.maps) material.maps[name] = read_map(name, file);
  return material;
}

// The picture must not take the place of what it is made from.
void check_output(const PreviewWork& work, const std::vector<TextureFiles>& textures,
                  const fs::path& output) {
  const std::string reader = "the preview is made from";
  std::vector<InputFile> read;
  for (const std::string& image : work.images) read.push_back({image, reader});
  for (const TextureFiles& texture : textures)
    for (const auto& [name, file] : texture.maps) read.push_back({file, reader});
  for (const std::string& map : work.maps) read.push_back({map.substr(map.find('=') + 1), reader});
  read.push_back({work.params.environment, reader});
  read.push_back({work.params.shape, reader});
  try {
    ProtectedFiles(read).check(output);
  } catch (const Error& error) {
    throw ConfigError("--output {}: {}", output.string(), error.what());
  }
}

// "height=FILE", in place of what was found.
void add_named_maps(TextureFiles& texture, const std::vector<std::string>& maps) {
  for (const std::string& map : maps) {
    const std::size_t equals = map.find('=');
    if (equals == std::string::npos) throw ConfigError("--map {}: must be name=file", map);
    texture.maps[map.substr(0, equals)] = map.substr(equals + 1);
  }
}

PreviewMaterial read_volume(const std::vector<std::string>& slices) {
  PreviewMaterial material;
  for (const std::string& slice : slices) material.volume.slices.push_back(read_colours(slice));
  return material;
}

bool is_name(const std::string& image) { return FileOrName(image).is_name(); }

}  // namespace

Image read_colours(const fs::path& file) {
  const ImageFile read = read_image(file);
  return is_coded(read.encoding.pixel_type) ? linear_picture(read.image) : read.image;
}

PreviewFile make_preview(const PreviewWork& work, const fs::path& output, const Control& control) {
  check_preview(work.params);
  PreviewFile result;
  const bool solid = work.params.mapping == Mapping::solid;
  const bool slices = solid && !std::all_of(work.images.begin(), work.images.end(), is_name);
  std::vector<TextureFiles> textures;
  if (!slices) textures = grouped(work.images);
  for (TextureFiles& texture : textures)
    if (!is_name(texture.picture.string())) find_beside(texture, result.used);
  if (!textures.empty()) add_named_maps(textures.front(), work.maps);
  check_output(work, textures, output);

  std::vector<PreviewMaterial> materials;
  for (const TextureFiles& texture : textures)
    materials.push_back(is_name(texture.picture.string())
                            ? procedural_material(texture.picture.string(), work.set, solid)
                            : read_texture(texture));
  if (slices) materials.push_back(read_volume(work.images));
  const Image environment =
      work.params.environment.empty() ? Image() : read_colours(work.params.environment);
  const Image rendered = render_preview(work.params, materials, environment, control);
  write_image(output, shown_preview(work.params, rendered), {});
  return result;
}

}  // namespace gramloom
