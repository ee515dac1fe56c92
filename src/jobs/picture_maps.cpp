#include "jobs/picture_maps.h"

#include <algorithm>

#include "core/error.h"
#include "io/image_file.h"
#include "io/json_fields.h"
#include "jobs/machine.h"
#include "jobs/protected_files.h"
#include "jobs/results.h"
#include "runs/job_files.h"
#include "surface/height_from_normals.h"

namespace gramloom {

namespace {

namespace fs = std::filesystem;

constexpr const char* maps_mark = "gramloom:maps";  // in the metadata of every map

std::vector<std::string> names_of_maps(const MapWork& work) {
  std::vector<std::string> names;
  if (work.source == MapSource::photo) names = {"colour", "height", "roughness"};
  if (work.source == MapSource::normal) names = {"height"};
  for (const std::string& name : maps_asked(work.maps)) names.push_back(name);
  return names;
}

// "bricks" of "bricks_height.png".
std::string stem_of(const fs::path& picture) {
  const std::string stem = picture.stem().string();
  for (const std::string_view end : {"_height", "_normal"})
    if (stem.size() > end.size() && stem.ends_with(end))
      return stem.substr(0, stem.size() - end.size());
  return stem;
}

// A height from zero up in its own units, as an integer file holds it: with 1 as its most.
float highest_of(const Image& height) {
  const float highest = *std::max_element(height.pixels.begin(), height.pixels.end());
  return highest > 0 ? highest : 1;
}

// The height of the picture, and what else is made of it directly.
struct Start {
  Image height;
  std::map<std::string, Image> maps;  // as they are written
};

Start start_of(const MapWork& work, const Image& picture) {
  Start start;
  if (work.source == MapSource::photo) {
    start.maps = material_from_photo(picture, work.photo);
    start.height = start.maps.at("height");
  } else if (work.source == MapSource::normal) {
    start.height = height_from_normals(colours_to_normals(picture, work.maps.green),
                                       work.maps.strength, work.tile);
    start.maps["height"] = start.height;
  } else {
    start.height = one_channel(picture);
  }
  return start;
}

bool holds_integers(const OutputFormat& format) {
  const PixelType type = stored_type(format.extension, format.encoding.pixel_type);
  return type == PixelType::uint8 || type == PixelType::uint16;
}

OutputFormat format_of(const MapWork& work, const ImageFile& picture, const std::string& map,
                       int channels) {
  Config config;
  config.format = work.format;
  config.pixel_type = work.pixel_type;
  const PixelType type = picture.encoding.pixel_type;
  if (map == "colour") return output_format(config, picture.encoding, channels);
  // What was made a height has finer steps than the picture's.
  const bool finer = map == "height" && type == PixelType::uint8;
  return output_format(config, {finer ? PixelType::uint16 : type, "", {}}, channels);
}

std::string file_text(const fs::path& file) {
  return to_text(Json(valid_utf8(file.generic_string())));
}

// An exemplar's table: the maps but for the colours.
std::string exemplar_table(const MapWork& work, const std::vector<std::string>& names,
                           const std::vector<fs::path>& files) {
  std::string maps, image;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "colour") {
      image = file_text(files[i]);
      continue;
    }
    const bool down = names[i] == "normal" && work.maps.green == GreenAxis::down;
    maps +=
        fmt::format("{}{} = {}", maps.empty() ? "" : ", ", names[i],
                    down ? fmt::format("{{ image = {}, green = \"down\" }}", file_text(files[i]))
                         : file_text(files[i]));
  }
  return fmt::format("[[exemplar]]\nname  = {}\nimage = {}\nmaps  = {{ {} }}\n",
                     file_text(stem_of(work.picture)), image, maps);
}

Metadata metadata_of(const MapWork& work) {
  Json made_by{{"gramloom", version()}, {"picture", valid_utf8(work.picture.filename().string())}};
  made_by[std::string(MapParams::name)] = to_json_value(work.maps);
  if (work.source == MapSource::photo)
    made_by[std::string(PhotoParams::name)] = to_json_value(work.photo);
  return {{maps_mark, to_text(made_by, -1, true)}};
}

void note_guesses(MadeMaps& made, const std::string& name, const std::string& file) {
  if (name == "height")
    made.notes.push_back(file + ": guessed from brightness; look at it before you trust it");
  if (name == "roughness") made.notes.push_back(file + ": guessed from the guessed height");
}

ImageFile read_named(const fs::path& picture) {
  try {
    return read_image(picture);
  } catch (const Error& error) {
    throw ConfigError("{}", error.what());
  }
}

}  // namespace

MadeMaps make_maps(const MapWork& work) {
  const std::vector<std::string> names = names_of_maps(work);
  const fs::path folder = work.output.empty() ? work.picture.parent_path() : work.output;
  const ImageFile picture = read_named(work.picture);
  MadeMaps made;
  std::vector<OutputFormat> formats;
  try {
    check_fields(work.maps);
    check_fields(work.photo);
    const ProtectedFiles inputs({{work.picture, "the maps are made of"}});
    for (const std::string& name : names) {
      const int channels = name == "colour" ? picture.image.channels : name == "normal" ? 3 : 1;
      formats.push_back(format_of(work, picture, name, channels));
      made.files.push_back(
          folder / fmt::format("{}_{}{}", stem_of(work.picture), name, formats.back().extension));
      check_replaced(made.files.back(), inputs, maps_mark);
    }
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    throw ConfigError("maps {}: {}", work.picture.string(), error.what());
  }
  Start start;
  try {
    start = start_of(work, picture.image);
  } catch (const Error& error) {
    throw ConfigError("{}: {}", work.picture.string(), error.what());
  }
  start.maps.merge(maps_of_height(start.height, work.maps, work.tile));
  if (!folder.empty()) create_folder(folder);
  const Metadata metadata = metadata_of(work);
  for (const std::string& note : picture.notes)
    made.notes.push_back(fmt::format("{}: {}", work.picture.filename().string(), note));
  for (std::size_t i = 0; i < names.size(); ++i) {
    Image& map = start.maps.at(names[i]);
    const std::string file = made.files[i].filename().string();
    if (names[i] == "height" && work.source == MapSource::normal && holds_integers(formats[i])) {
      const float highest = highest_of(map);
      for (float& value : map.pixels) value /= highest;
      made.notes.push_back(fmt::format("{}: 1 stands for {:g} pixels: use it with strength = {:g}",
                                       file, double{highest} * work.maps.strength,
                                       double{highest} * work.maps.strength));
    }
    Metadata own = metadata;
    if (names[i] == "normal") own.merge(green_metadata(work.maps.green));
    for (const std::string& note : write_image(made.files[i], map, formats[i].encoding, own))
      made.notes.push_back(file + ": " + note);
    if (work.source == MapSource::photo) note_guesses(made, names[i], file);
  }
  if (work.source == MapSource::photo) made.config = exemplar_table(work, names, made.files);
  return made;
}

}  // namespace gramloom
